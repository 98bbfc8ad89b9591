// The distance to an ellipsoid in extended precision, the reference for the errors of doubles and floats.
#pragma once

#include <bodice/geometry/ellipsoid.hpp>

namespace extremes_bench {

/// The signed distance, negative inside, by bisection of Eberly's function in long double. It starts from the
/// same bits as the algorithms and is good to about 1e-18 of the longest radius and the distance from the
/// center. Points must not lie in the plane of the two longest axes, because only outside of it the root is
/// unique.
double signed_distance(const bodice::geometry::Ellipsoid& ellipsoid, const bodice::geometry::Vec3& point);

}  // namespace extremes_bench
