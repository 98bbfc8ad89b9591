// How a relief table at rest is read in a pose. The layers that pose tables and that solve them anew share
// it.
#pragma once

#include <bodice/geometry/types.hpp>

namespace bodice::inline v0_1::proxy {

/// Where a table at rest is read for one direction of a pose, and how its values are changed for the pose.
struct TableReading {
  geometry::Vec3 direction = geometry::Vec3::UnitX();  ///< at rest, not of unit length
  double scale = 1.0;                                  ///< factor on the table's lengths: the ellipsoid's
  double growth_m = 0.0;  ///< by how much the skin's height over the ellipsoid has grown
  double burial_m = 0.0;  ///< kappa b of eq. (4') in posed_proxy.hpp
};

}  // namespace bodice::proxy
