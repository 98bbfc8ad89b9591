#include "cgal_mvee.hpp"

#ifdef BENCH_CGAL
#include <numbers>
#include <vector>

#include <CGAL/Approximate_min_ellipsoid_d.h>
#include <CGAL/Approximate_min_ellipsoid_d_traits_3.h>
#include <CGAL/MP_Float.h>
#include <CGAL/Simple_cartesian.h>

namespace mvee_bench {

double cgal_volume(std::span<const bodice::geometry::Vec3> points, double epsilon) {
  using Kernel = CGAL::Simple_cartesian<double>;
  using Traits = CGAL::Approximate_min_ellipsoid_d_traits_3<Kernel, CGAL::MP_Float>;
  std::vector<Kernel::Point_3> in;
  for (const auto& p : points) in.emplace_back(p.x(), p.y(), p.z());
  CGAL::Approximate_min_ellipsoid_d<Traits> ellipsoid(epsilon, in.begin(), in.end());
  if (!ellipsoid.is_full_dimensional()) return 0.0;
  double volume = 4.0 / 3.0 * std::numbers::pi;
  for (auto length = ellipsoid.axes_lengths_begin(); length != ellipsoid.axes_lengths_end(); ++length)
    volume *= *length;
  return volume;
}

}  // namespace mvee_bench
#endif
