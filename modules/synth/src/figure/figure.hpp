// The skeleton of a body of stature 1 in its rest pose, and the numbers that shape its flesh.
//
//   rest pose: trunk upright on the y axis, facing +z, arms 45 degrees below the horizontal with the
//   thumbs in front, legs 12 degrees apart from the vertical, feet flat
//
// All lengths here are in statures; make_body scales at the end.
#pragma once

#include <array>
#include <string_view>

#include <bodice/synth/body.hpp>

namespace bodice::inline v0_1::synth {

using geometry::Mat3;
using geometry::Vec3;

/// A bone. Those of limbs are in pairs, left first.
enum class Bone : std::uint8_t {
  kPelvis,
  kSpine,
  kChest,
  kNeck,
  kHead,
  kClavicleL,
  kClavicleR,
  kUpperArmL,
  kUpperArmR,
  kForearmL,
  kForearmR,
  kHandL,
  kHandR,
  kFingersL,
  kFingersR,
  kFingertipsL,
  kFingertipsR,
  kThumbL,
  kThumbR,
  kThighL,
  kThighR,
  kCalfL,
  kCalfR,
  kFootL,
  kFootR,
  kToesL,
  kToesR,
};

inline constexpr int kBoneCount = 27;

/// The bone on the given side (0 left, 1 right) of the pair of `left`.
constexpr Bone of_side(Bone left, int side) {
  return static_cast<Bone>(static_cast<int>(left) + side);
}
constexpr int index(Bone bone) {
  return static_cast<int>(bone);
}

/// The bone that this one is attached to; the pelvis is its own parent.
Bone parent(Bone bone);

/// The name of the joint at the bone's near end: "elbow_l" for the left forearm.
std::string_view joint_name(Bone bone);

/// How the body differs from the average of its sex, in factors of cross-section radii.
struct Build {
  double hip = 1.0, waist = 1.0, chest = 1.0, shoulder = 1.0;
  double arm = 1.0, leg = 1.0, head = 1.0, bust = 1.0, seat = 1.0;
  double neck = 1.0;
};

/// The axes of an arm or leg in the rest pose; `along` runs from the trunk to the end of the limb.
struct LimbAxes {
  Vec3 along;
  Vec3 out;    ///< toward the back of the hand, or the outer side of the leg
  Vec3 front;  ///< +z
};

/// Lengths, joints and build of one body, in statures.
struct Figure {
  body::Sex sex = body::Sex::kFemale;
  body::Proportions p;
  Build build;
  bool pregnant = false;
  double fat = 0.0;  ///< 0 is the slim body of the tables; more grows girths, most of all the belly's
  double hip_height = 0.0, ankle_height = 0.0;
  std::array<Vec3, kBoneCount> joint;  ///< near end of each bone, rest pose
  std::array<LimbAxes, 2> arm, leg;    ///< left, right

  double female() const { return sex == body::Sex::kFemale ? 1.0 : 0.0; }
  double upper_arm_length() const { return p.upper_arm - kShoulderDrop - kCapitulum; }
  double forearm_length() const { return p.forearm + kCapitulum; }
  double arm_length() const { return upper_arm_length() + forearm_length(); }  ///< shoulder joint to wrist
  double leg_length() const { return hip_height - ankle_height; }              ///< hip joint to ankle joint
  double thigh_length() const { return hip_height - p.knee_height - kCondyle; }

  static constexpr double kShoulderDrop = 0.012;  ///< acromion above the center of the joint
  // Surveys measure to radiale and tibiale, the edges of the bones of forearm and shin. Elbow and knee turn
  // about the centers of the knuckles that roll on them, a radius above: about 11 and 21 mm.
  static constexpr double kCapitulum = 0.0065, kCondyle = 0.0125;
  static constexpr double kLegSpread_rad = 0.20943951023931953;
  static constexpr double kArmDrop_rad = 0.78539816339744828;
};

/// The figure of the given sex, age and proportions. Seed 0 is the average; other seeds vary lengths and
/// girths within the spread of the surveys.
Figure make_figure(const BodyOptions& options, const body::Proportions& proportions);

}  // namespace bodice::synth
