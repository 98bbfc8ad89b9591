#pragma once

#include <span>

#include <bodice/geometry/types.hpp>

namespace mvee_bench {

#ifdef BENCH_CGAL
/// Volume of the ellipsoid of CGAL's Approximate_min_ellipsoid_d at `epsilon`; 0 if CGAL finds the set flat.
double cgal_volume(std::span<const bodice::geometry::Vec3> points, double epsilon);
#endif

}  // namespace mvee_bench
