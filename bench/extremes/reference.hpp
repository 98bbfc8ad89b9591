// The distance to an ellipsoid in extended precision: what doubles and floats are judged by.
#pragma once

#include <bodice/geometry/ellipsoid.hpp>

namespace extremes_bench {

/// Signed, negative inside. Bisection of Eberly's root in long double, from the same bits that the algorithms
/// see; good to about 1e-18 of the longest radius and the distance from the center. For points off the plane
/// of the two longest axes, where the root is unique.
double signed_distance(const bodice::geometry::Ellipsoid& ellipsoid, const bodice::geometry::Vec3& point);

}  // namespace extremes_bench
