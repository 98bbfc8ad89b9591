// Where joints lie from the curves they are found by: fractions of the stature, along the axes that are
// named.
//
// Least squares over 24 made bodies (random sex, build and mass, eight poses) and 16 rigged bodies of 5
// builds in 7 poses, with equal weight for each joint. Both kinds of rigs put some joints differently:
// shoulders by 15 mm, spine joints by more. The offsets lie between.
#pragma once

namespace bodice::rigging::offsets {

/// From the border of arm and torso, along the upper arm, to the side, up the trunk, to the front.
struct ShoulderOffset {
  double along = -0.0096, side = -0.0061, up = 0.0080, front = 0.0025;
};
/// From the border of leg and torso, along the thigh, to the side, up the pelvis, to the front.
struct HipOffset {
  double along = -0.0137, side = 0.0018, up = 0.0109, front = -0.0023;
};
/// From a border of the torso's parts, along the axes of the pelvis and of the chest.
struct SpineOffset {
  double pelvis_up, pelvis_front, chest_up, chest_front;
};
inline constexpr ShoulderOffset kShoulder;
inline constexpr HipOffset kHip;
inline constexpr SpineOffset kSpineLower{-0.0103, -0.0124, 0.0038, -0.0091};   // from the waist
inline constexpr SpineOffset kSpineMiddle{0.0080, -0.0153, -0.0682, -0.0048};  // from the chest
inline constexpr SpineOffset kSpineUpper{0.0140, -0.0381, -0.0140, 0.0047};    // from the chest
/// The pelvis joint above the middle of the hips.
inline constexpr double kPelvisUp = 0.030;
/// From the landmark, along the chest's axes.
inline constexpr double kNeckUp = -0.0015, kNeckFront = -0.0005;
/// The head's joint from the neck landmark: a share of the line to the crown, and along the chest's axes.
inline constexpr double kHeadShare = 0.4079, kHeadUp = -0.0078, kHeadFront = 0.0091;
/// The clavicle's joint between neck and shoulder: a share of the line, and to the front.
inline constexpr double kClavicleShare = 0.25, kClavicleDown = 0.024, kClavicleFront = 0.014;

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
