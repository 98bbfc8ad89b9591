#pragma once

#include <span>

#include <bodice/geometry/types.hpp>

namespace mvee_bench {

#ifdef BENCH_CGAL
/// Volume of the ellipsoid that CGAL's Approximate_min_ellipsoid_d gives at `epsilon`; 0 if the set is flat
/// to it.
double cgal_volume(std::span<const bodice::geometry::Vec3> points, double epsilon);
#endif

}  // namespace mvee_bench
