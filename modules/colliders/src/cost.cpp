#include <algorithm>
#include <limits>

#include "cost_by.hpp"

namespace bodice::colliders {
ReductionCost cost_of(const engine::Context& context, const proxy::BodyProxy& proxy, const SkinPoints& points,
                      std::span<const PlainShape> shapes) {
  return cost_by(context, proxy, points, [&](const Vec3& point) {
    double least = std::numeric_limits<double>::infinity();
    for (const PlainShape& shape : shapes) least = std::min(least, shape_distance(shape, point).distance);
    return least;
  });
}

ReductionCost cost_of_ellipsoids(const engine::Context& context, const proxy::BodyProxy& proxy,
                                 const SkinPoints& points) {
  return cost_by(context, proxy, points, [&](const Vec3& point) {
    double least = std::numeric_limits<double>::infinity();
    for (const proxy::ProxyEllipsoid& e : proxy.ellipsoids())
      least = std::min(least, geometry::closest_point(e.shape, point).signed_distance);
    return least;
  });
}

}  // namespace bodice::colliders
