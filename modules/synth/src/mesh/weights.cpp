#include "mesh/weights.hpp"

#include <algorithm>
#include <cmath>

namespace bodice::inline v0_1::synth {
namespace {

// Rounds of averaging with the neighbors, which spread bends over about 6 % of stature on trunk and limbs.
constexpr int kSmoothings = 9;
constexpr int kDigitSmoothings = 2;

/// The border of a limb's skin: a plane near a joint, in the rest pose, on the left side.
struct Cut {
  Vec3 from_joint;  ///< statures
  Vec3 normal;      ///< toward the end of the limb
};

// The cuts follow rigged scans: the shoulder's is upright, the groin's slants, the kneecap belongs to the
// thigh, the bend of the elbow to the forearm.
const Cut kShoulderCut{{-0.004, 0.0, 0.0}, {0.98, 0.12, 0.16}};
const Cut kElbowCut{{-0.005, 0.005, 0.0}, {0.707, -0.707, 0.0}};
const Cut kHipCut{{-0.006, -0.019, 0.0}, {0.56, -0.81, 0.15}};
const Cut kKneeCut{{0.0, -0.011, -0.003}, {0.28, -0.87, -0.40}};

/// How far p is beyond the cut of the bone that starts there; negative before it.
double beyond(const Figure& f, const Cut& cut, Bone left, int side, const Vec3& p) {
  Vec3 from = p - f.joint[index(of_side(left, side))];
  if (side == 1) from.x() = -from.x();
  return cut.normal.dot(from - cut.from_joint);
}

int side_at(const Vec3& p) {
  return p.x() >= 0.0 ? 0 : 1;
}

Bone trunk_bone(const Figure& f, const Vec3& p) {
  const double pelvis_top = 0.5 * (f.joint[index(Bone::kPelvis)].y() + f.joint[index(Bone::kSpine)].y());
  if (p.y() < pelvis_top) return Bone::kPelvis;
  if (p.y() < f.joint[index(Bone::kChest)].y()) return Bone::kSpine;
  if (p.y() > f.p.axilla_height && std::abs(p.x()) > 0.045) return of_side(Bone::kClavicleL, side_at(p));
  return Bone::kChest;
}

Bone arm_bone(const Figure& f, int side, const Vec3& p) {
  if (beyond(f, kElbowCut, Bone::kForearmL, side, p) < 0.0) return of_side(Bone::kUpperArmL, side);
  const double s = (p - f.joint[index(of_side(Bone::kUpperArmL, side))]).dot(f.arm[side].along);
  return of_side(s < f.arm_length() ? Bone::kForearmL : Bone::kHandL, side);
}

/// The bone of skin beyond the shoulder: on a wide chest it is the arm only where the arm stands out of it.
Bone chest_or_arm_bone(const Figure& f, const Flesh& flesh, const Vec3& p) {
  const int side = side_at(p);
  const bool arm =
      beyond(f, kShoulderCut, Bone::kUpperArmL, side, p) > 0.0 &&
      flesh.own_value(region_of_side(Region::kArmL, side), p) < flesh.own_value(Region::kTrunk, p);
  return arm ? arm_bone(f, side, p) : trunk_bone(f, p);
}

Bone leg_bone(const Figure& f, int side, const Vec3& p) {
  if (beyond(f, kKneeCut, Bone::kCalfL, side, p) < 0.0) return of_side(Bone::kThighL, side);
  const Vec3& ankle = f.joint[index(of_side(Bone::kFootL, side))];
  if (p.z() > f.joint[index(of_side(Bone::kToesL, side))].z() && p.y() < ankle.y() + 0.02)
    return of_side(Bone::kToesL, side);
  const double heel_to_instep = p.y() - ankle.y() - 0.35 * (p.z() - ankle.z());
  return of_side(heel_to_instep < 0.0 ? Bone::kFootL : Bone::kCalfL, side);
}

Bone trunk_or_limb_bone(const Figure& f, const Flesh& flesh, const Vec3& p) {
  if (p.y() > f.p.waist_height) return chest_or_arm_bone(f, flesh, p);
  const int side = side_at(p);
  return beyond(f, kHipCut, Bone::kThighL, side, p) > 0.0 ? leg_bone(f, side, p) : trunk_bone(f, p);
}

Bone digit_bone(const Figure& f, Region region, const Vec3& p) {
  const int side = side_of(region);
  const int digit = (static_cast<int>(region) - static_cast<int>(Region::kDigits)) % kDigitsPerHand;
  if (digit == 4) return of_side(Bone::kThumbL, side);
  const double s = (p - f.joint[index(of_side(Bone::kFingertipsL, side))]).dot(f.arm[side].along);
  return of_side(s < 0.0 ? Bone::kFingersL : Bone::kFingertipsL, side);
}

Bone head_bone(const Figure& f, const Vec3& p) {
  const Vec3& joint = f.joint[index(Bone::kHead)];
  return p.y() - joint.y() + 0.5 * (p.z() - joint.z()) < 0.01 ? Bone::kNeck : Bone::kHead;
}

Bone nearest_bone(const Figure& f, const Flesh& flesh, Region region, const Vec3& p) {
  switch (region) {
    case Region::kTrunk:
      return trunk_or_limb_bone(f, flesh, p);
    case Region::kCrotch:
      return Bone::kPelvis;
    case Region::kHead:
      return head_bone(f, p);
    case Region::kArmL:
    case Region::kArmR:
      return chest_or_arm_bone(f, flesh, p);
    case Region::kLegL:
    case Region::kLegR:
      return trunk_or_limb_bone(f, flesh, p);
    default:
      return digit_bone(f, region, p);
  }
}

}  // namespace

std::vector<BoneWeights> bone_weights(const Figure& figure, const Skin& skin) {
  const std::size_t n = skin.positions.size();
  const Flesh flesh(figure);
  std::vector<BoneWeights> weights(n, BoneWeights::Zero());
  for (std::size_t v = 0; v < n; ++v)
    weights[v][index(nearest_bone(figure, flesh, skin.mesh.region[v], skin.positions[v]))] = 1.0f;
  const Neighbors near(skin.mesh);
  std::vector<BoneWeights> next(n);
  for (int i = 0; i < kSmoothings; ++i) {
    for (std::size_t v = 0; v < n; ++v) {
      next[v] = weights[v];
      if (is_digit(skin.mesh.region[v]) && i >= kDigitSmoothings) continue;
      BoneWeights sum = BoneWeights::Zero();
      for (std::size_t k = near.start[v]; k < near.start[v + 1]; ++k) sum += weights[near.vertex[k]];
      next[v] = 0.4f * weights[v] + 0.6f / static_cast<float>(near.start[v + 1] - near.start[v]) * sum;
    }
    weights.swap(next);
  }
  return weights;
}

body::Part part_of(Bone bone) {
  using body::Part;
  if (bone <= Bone::kChest || bone == Bone::kClavicleL || bone == Bone::kClavicleR) return Part::kTorsoLL;
  if (bone <= Bone::kHead) return Part::kHead;
  const int side = (index(bone) - index(Bone::kClavicleL)) % 2;
  const auto sided = [&](Part left) { return static_cast<Part>(static_cast<int>(left) + side); };
  if (bone <= Bone::kUpperArmR) return sided(Part::kUpperArmL);
  if (bone <= Bone::kThumbR) return sided(Part::kForearmL);
  return sided(bone <= Bone::kThighR ? Part::kThighL : Part::kCalfL);
}

std::array<float, body::kPartCount> part_shares(const BoneWeights& weights) {
  std::array<float, body::kPartCount> shares{};
  for (int b = 0; b < kBoneCount; ++b) shares[static_cast<int>(part_of(static_cast<Bone>(b)))] += weights[b];
  return shares;
}

}  // namespace bodice::synth
