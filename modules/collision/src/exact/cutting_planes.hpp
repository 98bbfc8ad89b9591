// Pushes a particle that is below its clearance to the closest point that keeps the clearance, or violates it
// least.
#pragma once

#include "exact/halfspaces.hpp"
#include "exact/near_field.hpp"

namespace bodice::inline v0_1::collision {

/// Where a push by cutting planes led.
struct PushResult {
  geometry::Vec3 position;
  ReliefSample sample;  ///< at that position
  Halfspaces contact;   ///< the planes that hold the particle there
  int rounds = 0;
  bool clear = false;     ///< sample.distance_m >= the clearance
  bool set_back = false;  ///< the planes were set back: a clear position is then not the closest one
};

/// Pushes p by cutting planes; `start` is near.at(p). The push aims at `clearance_m` plus `overshoot_m` and
/// is not longer than `longest_m`. At most kPlaneRounds evaluations.
/// A result that is not clear is the best position found: midway where two surfaces face each other, or p
/// itself.
PushResult push_by_planes(NearField& near, const geometry::Vec3& p, const ReliefSample& start,
                          double clearance_m, double overshoot_m, double longest_m);

}  // namespace bodice::collision
