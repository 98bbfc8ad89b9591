#include "scene.hpp"

#include <cmath>

namespace bench {

using namespace bodice;
using geometry::Vec3;

collision::Collider torso() {
  proxy::BodyProxy::Data data;
  data.stature_m = 1.7;
  for (int ring = 0; ring < 9; ++ring) {
    for (int k = 0; k < 10; ++k) {
      const double angle = 0.6283185307179586 * k;
      proxy::ProxyEllipsoid e;
      e.shape.center = Vec3(0.10 * std::cos(angle), 0.9 + 0.07 * ring, 0.07 * std::sin(angle));
      e.shape.radii = Vec3(0.07, 0.08, 0.07);
      data.ellipsoids.push_back(e);
    }
  }
  return collision::Collider(*proxy::BodyProxy::make(std::move(data)));
}

geometry::TriMesh poncho(std::size_t particles) {
  const auto side = static_cast<geometry::Index>(std::lround(std::sqrt(static_cast<double>(particles))));
  geometry::TriMesh mesh;
  for (geometry::Index j = 0; j < side; ++j)
    for (geometry::Index i = 0; i < side; ++i)
      mesh.positions.emplace_back(1.2 * i / (side - 1) - 0.6, 1.55, 1.2 * j / (side - 1) - 0.6);
  for (geometry::Index j = 0; j + 1 < side; ++j)
    for (geometry::Index i = 0; i + 1 < side; ++i) {
      const geometry::Index a = j * side + i, c = a + side;
      mesh.triangles.push_back({a, c, a + 1});
      mesh.triangles.push_back({a + 1, c, c + 1});
    }
  return mesh;
}

}  // namespace bench
