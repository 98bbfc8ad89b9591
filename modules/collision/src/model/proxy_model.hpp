// The proxy as the float kernels read it.
#pragma once

#include <optional>

#include "model/baked.hpp"
#include "model/relief_tables.hpp"
#include "model/tolerances.hpp"

namespace bodice::inline v0_1::collision {

/// The ellipsoids of a proxy and, of a proxy with relief, their tables. It is read by all tasks of a call,
/// and changes only when the proxy moves.
struct ProxyModel {
  Baked baked;
  std::optional<ReliefTables> relief;

  /// Whether burial takes part in the choice of owners, as it does in the poses of a bound proxy.
  bool buries() const { return relief && relief->buries(); }
  /// How much farther than the owner another ellipsoid may be and still change the distance, meters.
  float blend_m() const { return relief ? relief->blend_m : 0.0f; }
  /// How much higher than the distance of the nearest ellipsoid a score may be and its particle still be
  /// certain, meters. Particles that are not are searched again.
  float certain_m() const { return buries() ? kCertainScore * relief->blend_m : 0.0f; }
  /// How much farther than the nearest an ellipsoid may be and still be a candidate, meters. All searches for
  /// candidates and the candidate cache keep so much more.
  float beyond_m() const { return blend_m() + certain_m(); }
};

}  // namespace bodice::collision
