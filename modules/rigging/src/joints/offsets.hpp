// Leans of standing bodies, and positions of the joints of hands and feet as fractions of the stature: fitted
// by hand to 24 made bodies and 16 rigged ones. Joints that lie off the curves of the trunk have data
// (offset_joints.hpp).
#pragma once

namespace bodice::inline v0_1::rigging::offsets {

/// Lean of a standing body's axis, positive to the front: from hips to waist, and from waist to neck.
inline constexpr double kPelvisLean_deg = 8.0, kChestLean_deg = -4.6;
/// Lean of the axis from neck to crown to the front, on standing bodies.
inline constexpr double kHeadLean_deg = 10.0;

/// Geodesic distance of the wrist from the tip of the middle finger; the joint lies a little toward the
/// elbow.
inline constexpr double kHand = 0.107, kWristUp = 0.0065;

/// Lengths of a foot: distance from the tip of the toes that its skin reaches, height of the ankle above the
/// sole, and distance of the ankle from the rear of the section there. kBall is the ball's share of the
/// foot's length.
inline constexpr double kFootReach = 0.175, kAnkleHeight = 0.043, kAnkleFront = 0.026, kBall = 0.68;

}  // namespace bodice::rigging::offsets
