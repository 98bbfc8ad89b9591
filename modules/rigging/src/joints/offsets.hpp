// How standing bodies lean, and where the joints of hands and feet lie, as fractions of the stature: from 24
// made bodies and 16 rigged ones. What lies off the curves of the trunk is data (offset_joints.hpp).
#pragma once

namespace bodice::inline v0_1::rigging::offsets {

/// Standing bodies' axis from hips to waist leans to the front by this, and from waist to neck to the back.
inline constexpr double kPelvisLean_deg = 8.0, kChestLean_deg = -4.6;
/// And from neck to crown to the front.
inline constexpr double kHeadLean_deg = 10.0;

/// Geodesic distance of the wrist from the tip of the middle finger; the joint lies a little toward the
/// elbow.
inline constexpr double kHand = 0.107, kWristUp = 0.0065;

/// The foot: how far the skin around it reaches from the tip of the toes, the ankle's height above the sole
/// and its distance from the rear of the section there, the ball's share of the foot's length.
inline constexpr double kFootReach = 0.175, kAnkleHeight = 0.043, kAnkleFront = 0.026, kBall = 0.68;

}  // namespace bodice::rigging::offsets
