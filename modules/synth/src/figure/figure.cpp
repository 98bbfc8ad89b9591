#include "figure/figure.hpp"

#include <algorithm>
#include <cmath>

#include <bodice/engine/random.hpp>

namespace bodice::inline v0_1::synth {
namespace {

constexpr std::array<Bone, kBoneCount> kParents = {
    Bone::kPelvis,   Bone::kPelvis,    Bone::kSpine,     Bone::kChest,     Bone::kNeck,      Bone::kChest,
    Bone::kChest,    Bone::kClavicleL, Bone::kClavicleR, Bone::kUpperArmL, Bone::kUpperArmR, Bone::kForearmL,
    Bone::kForearmR, Bone::kHandL,     Bone::kHandR,     Bone::kFingersL,  Bone::kFingersR,  Bone::kHandL,
    Bone::kHandR,    Bone::kPelvis,    Bone::kPelvis,    Bone::kThighL,    Bone::kThighR,    Bone::kCalfL,
    Bone::kCalfR,    Bone::kFootL,     Bone::kFootR};

constexpr std::array<std::string_view, kBoneCount> kJointNames = {
    "pelvis",     "spine_mid",  "spine_upper", "neck",    "head",    "clavicle_l", "clavicle_r",
    "shoulder_l", "shoulder_r", "elbow_l",     "elbow_r", "wrist_l", "wrist_r",    "knuckles_l",
    "knuckles_r", "fingers_l",  "fingers_r",   "thumb_l", "thumb_r", "hip_l",      "hip_r",
    "knee_l",     "knee_r",     "ankle_l",     "ankle_r", "ball_l",  "ball_r"};

/// A random factor around 1, within two standard deviations.
double factor(engine::Random& random, double deviation) {
  return 1.0 + deviation * std::clamp(random.normal(), -2.0, 2.0);
}

void vary(Figure& figure, std::uint64_t seed) {
  engine::Random random(seed, 0xB0D1);
  const auto shifted = [&](double& length, double deviation) {
    length += deviation * std::clamp(random.normal(), -2.0, 2.0);
  };
  // These are standard deviations in statures, over persons of one sex in ANSUR II.
  body::Proportions& p = figure.p;
  shifted(p.upper_arm, 0.006);
  shifted(p.forearm, 0.006);
  shifted(p.hand, 0.004);
  shifted(p.crotch_height, 0.011);
  shifted(p.knee_height, 0.006);
  shifted(p.waist_height, 0.008);
  shifted(p.foot_length, 0.005);
  shifted(p.head_length, 0.003);
  Build& b = figure.build;
  for (double* girth : {&b.hip, &b.waist, &b.chest}) *girth = factor(random, 0.05);
  for (double* girth : {&b.arm, &b.leg}) *girth = factor(random, 0.04);
  b.shoulder = factor(random, 0.035);
  b.head = factor(random, 0.02);
  b.bust = factor(random, 0.2);
  b.seat = factor(random, 0.12);
}

/// Blends an adult's proportions with those of a two-year-old. The numbers are the author's, after growth
/// charts: the head's share of the stature grows from 1/7.5 to 1/5, the legs' share falls from .47 to .37.
void make_young(Figure& f, double childhood) {
  body::Proportions& p = f.p;
  for (double* height : {&p.neck_height, &p.acromion_height}) *height -= 0.058 * childhood;
  for (double* height : {&p.axilla_height, &p.chest_height, &p.waist_height}) *height -= 0.065 * childhood;
  p.crotch_height -= 0.10 * childhood;
  p.knee_height -= 0.055 * childhood;
  p.head_length += 0.066 * childhood;
  p.upper_arm -= 0.022 * childhood;
  p.forearm -= 0.020 * childhood;
  p.hand -= 0.004 * childhood;
  Build& b = f.build;
  for (double* girth : {&b.hip, &b.waist, &b.chest, &b.arm, &b.leg}) *girth *= 1.0 + 0.12 * childhood;
  b.head *= 1.0 + 0.55 * childhood;
  b.neck *= 1.0 + 0.25 * childhood;
  b.bust *= 1.0 - 0.6 * childhood;
}

void place_trunk(Figure& f) {
  const body::Proportions& p = f.p;
  const auto at = [&](Bone bone) -> Vec3& { return f.joint[index(bone)]; };
  at(Bone::kPelvis) = {0.0, f.hip_height + 0.03, -0.012};
  at(Bone::kSpine) = {0.0, p.waist_height, -0.012};
  at(Bone::kChest) = {0.0, 0.5 * (p.waist_height + p.chest_height) + 0.02, -0.016};
  at(Bone::kNeck) = {0.0, p.neck_height - 0.012, -0.016};
  at(Bone::kHead) = {0.0, 1.0 - p.head_length + 0.035, 0.0};
}

void place_arm(Figure& f, int side) {
  const double sign = side == 0 ? 1.0 : -1.0;
  const double c = std::cos(Figure::kArmDrop_rad), s = std::sin(Figure::kArmDrop_rad);
  LimbAxes& axes = f.arm[side];
  axes = {{sign * c, -s, 0.0}, {sign * s, c, 0.0}, {0.0, 0.0, 1.0}};
  const auto at = [&](Bone left) -> Vec3& { return f.joint[index(of_side(left, side))]; };
  const double half_breadth = (f.female() > 0.0 ? 0.0925 : 0.1) * f.build.shoulder;
  const double palm = 0.52 * f.p.hand;
  at(Bone::kUpperArmL) = {sign * half_breadth, f.p.acromion_height - 0.028, -0.012};
  at(Bone::kClavicleL) = {sign * 0.25 * half_breadth, f.p.acromion_height - 0.015, 0.0};
  at(Bone::kForearmL) = at(Bone::kUpperArmL) + f.upper_arm_length() * axes.along;
  at(Bone::kHandL) = at(Bone::kForearmL) + f.forearm_length() * axes.along;
  at(Bone::kFingersL) = at(Bone::kHandL) + palm * axes.along;
  at(Bone::kFingertipsL) = at(Bone::kFingersL) + 0.22 * f.p.hand * axes.along;
  at(Bone::kThumbL) = at(Bone::kHandL) + 0.2 * f.p.hand * axes.along + 0.012 * axes.front;
}

void place_leg(Figure& f, int side) {
  const double sign = side == 0 ? 1.0 : -1.0;
  const double c = std::cos(Figure::kLegSpread_rad), s = std::sin(Figure::kLegSpread_rad);
  LimbAxes& axes = f.leg[side];
  axes = {{sign * s, -c, 0.0}, {sign * c, s, 0.0}, {0.0, 0.0, 1.0}};
  const auto at = [&](Bone left) -> Vec3& { return f.joint[index(of_side(left, side))]; };
  at(Bone::kThighL) = {sign * (f.female() > 0.0 ? 0.053 : 0.05), f.hip_height, -0.01};
  at(Bone::kCalfL) = at(Bone::kThighL) + f.thigh_length() * axes.along;
  at(Bone::kFootL) = at(Bone::kThighL) + f.leg_length() * axes.along;
  at(Bone::kToesL) = at(Bone::kFootL) + Vec3(0.0, -0.6 * f.ankle_height, 0.5 * f.p.foot_length);
}

}  // namespace

Bone parent(Bone bone) {
  return kParents[index(bone)];
}

std::string_view joint_name(Bone bone) {
  return kJointNames[index(bone)];
}

Figure make_figure(const BodyOptions& options, const body::Proportions& proportions) {
  Figure figure;
  figure.sex = options.sex;
  figure.p = proportions;
  figure.pregnant = options.pregnant;
  if (options.seed != 0) vary(figure, options.seed);
  make_young(figure, options.childhood);
  figure.hip_height = figure.p.crotch_height + 0.045;
  figure.ankle_height = 0.042;
  place_trunk(figure);
  for (int side = 0; side < 2; ++side) {
    place_arm(figure, side);
    place_leg(figure, side);
  }
  return figure;
}

}  // namespace bodice::synth
