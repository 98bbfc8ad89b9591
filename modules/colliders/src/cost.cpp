#include <algorithm>
#include <limits>

#include "cost_by.hpp"

namespace bodice::inline v0_1::colliders {
ReductionCost cost_of(const engine::Context& context, const proxy::BodyProxy& proxy, const SkinPoints& points,
                      std::span<const PlainShape> shapes) {
  const std::vector<BoundingBall> balls = bounding_balls(shapes);
  return cost_by(context, proxy, points, [&](const Vec3& point) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t s = 0; s < shapes.size(); ++s)
      if (!balls[s].is_farther(point, least))
        least = std::min(least, shape_distance(shapes[s], point).distance);
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
