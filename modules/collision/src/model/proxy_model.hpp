// The proxy as the float kernels read it.
#pragma once

#include <optional>

#include "model/baked.hpp"
#include "model/relief_tables.hpp"

namespace bodice::collision {

/// The ellipsoids of a proxy and, of a proxy with relief, their tables. It is read by all tasks of a call,
/// and changes only when the proxy moves.
struct ProxyModel {
  Baked baked;
  std::optional<ReliefTables> relief;

  /// How much farther than the nearest ellipsoid another one may be and still change the distance, meters.
  /// All searches for candidates and the candidate cache keep so much more.
  float beyond_m() const { return relief ? relief->blend_m : 0.0f; }
};

}  // namespace bodice::collision
