// Positions between the vertices of a skin.
#pragma once

#include <cmath>
#include <limits>

#include "skin/skin.hpp"

namespace bodice::inline v0_1::anatomy {

/// The mean of the skin around a vertex, weighed by area and by weight(v) >= 0: a position that does not jump
/// from vertex to vertex as the best one does, and hardly depends on how fine the mesh is. Only triangles
/// with all corners within `radius` meters take part; the vertex itself if none has weight. O(#F).
template <class Weight>
geometry::Vec3 soft_position(const Skin& skin, geometry::Index vertex, double radius, Weight weight) {
  const auto& positions = skin.mesh.positions;
  const geometry::Vec3 center = positions[vertex];
  const auto near = [&](geometry::Index v) {
    return skin.component[v] == 0 && (positions[v] - center).squaredNorm() <= radius * radius;
  };
  geometry::Vec3 moment = geometry::Vec3::Zero();
  double all = 0.0;
  for (std::size_t f = 0; f < skin.mesh.triangles.size(); ++f) {
    const auto& t = skin.mesh.triangles[f];
    if (!near(t[0]) || !near(t[1]) || !near(t[2])) continue;
    const double area = geometry::area_vector(skin.mesh, f).norm();
    for (const geometry::Index v : t) {
      const double share = area * static_cast<double>(weight(v));
      if (!std::isfinite(share)) continue;
      moment += share * (positions[v] - center);
      all += share;
    }
  }
  return all > 0.0 ? geometry::Vec3(center + moment / all) : center;
}

/// The vertex of the body nearest to a point, the lowest among equals; `otherwise` if there is none. O(#V).
inline geometry::Index vertex_near(const Skin& skin, const geometry::Vec3& point, geometry::Index otherwise) {
  geometry::Index best = otherwise;
  double least = std::numeric_limits<double>::infinity();
  for (geometry::Index v = 0; v < skin.mesh.positions.size(); ++v) {
    const double d = (skin.mesh.positions[v] - point).squaredNorm();
    if (skin.component[v] != 0 || !(d < least)) continue;
    least = d;
    best = v;
  }
  return best;
}

}  // namespace bodice::anatomy
