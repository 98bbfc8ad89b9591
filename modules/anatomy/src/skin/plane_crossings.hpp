// Where a plane cuts the skin.
#pragma once

#include "skin/skin.hpp"

namespace bodice::inline v0_1::anatomy {

struct Plane {
  geometry::Vec3 through, normal;
};

/// Calls visit(v, position) where an edge from vertex v of the body's own component crosses the plane. O(#F).
template <class Visit>
void for_each_crossing(const Skin& skin, const Plane& plane, Visit&& visit) {
  const auto& positions = skin.mesh.positions;
  for (const auto& t : skin.mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const geometry::Index v = t[k], w = t[(k + 1) % 3];
      if (skin.component[v] != 0) continue;
      const double side_v = (positions[v] - plane.through).dot(plane.normal),
                   side_w = (positions[w] - plane.through).dot(plane.normal);
      if ((side_v >= 0.0) != (side_w >= 0.0))
        visit(v, geometry::Vec3(positions[v] + side_v / (side_v - side_w) * (positions[w] - positions[v])));
    }
}

}  // namespace bodice::anatomy
