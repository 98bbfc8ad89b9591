// The unit directions of a table's texels.
#pragma once

#include <bodice/proxy/proxy_distance.hpp>

namespace bodice::inline v0_1::binding {

inline geometry::Vec3 texel_direction(int texel, int nodes_per_side) {
  const double last = nodes_per_side - 1;
  return proxy::octahedral_direction(2.0 * (texel % nodes_per_side) / last - 1.0,
                                     2.0 * (texel / nodes_per_side) / last - 1.0);
}

inline geometry::Vec3 surface_point(const geometry::Ellipsoid& e, const geometry::Vec3& direction) {
  return e.center + e.axes * e.radii.cwiseProduct(direction);
}

}  // namespace bodice::binding
