// One leg between a hip and a foot that both have their own positions.
#pragma once

#include "posture/figure.hpp"

namespace bodice::inline v0_1::rigging {

/// Rotations from joint frames to motion space.
struct LegPose {
  Mat3 thigh, calf, foot, toes;
};

/// The foot's frame and its ankle, motion space, meters: the heel or the ball stays where the flat foot has
/// it.
struct PlacedFoot {
  Mat3 frame;
  Vec3 ankle;
};
PlacedFoot place_foot(const LegLengths& leg, const FootPosture& posture, double leg_m);

/// The knee bends in the plane that holds hip, ankle and `knee_front`, toward the latter. An ankle out of
/// reach is approached as far as the leg is long.
LegPose solve_leg(const LegLengths& leg, const Vec3& hip, const PlacedFoot& foot, const Vec3& knee_front);

}  // namespace bodice::rigging
