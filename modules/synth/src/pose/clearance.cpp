// Based on: Christer Ericson. Real-Time Collision Detection. 2005. - section 5.1.9 (closest points of
// segments)
#include "pose/clearance.hpp"

#include <algorithm>
#include <vector>

namespace bodice::inline v0_1::synth {
namespace {

struct Capsule {
  Vec3 a, b;
  double radius;
  int group;  ///< capsules of neighboring groups touch by nature
};

enum Group { kTrunkGroup, kHeadGroup, kArmGroup, kForearmGroup = 4, kThighGroup = 6, kCalfGroup = 8 };

double segment_distance(const Capsule& m, const Capsule& n) {
  const Vec3 d1 = m.b - m.a, d2 = n.b - n.a, r = m.a - n.a;
  const double a = std::max(d1.squaredNorm(), 1e-12), e = std::max(d2.squaredNorm(), 1e-12);
  const double b = d1.dot(d2), c = d1.dot(r), f = d2.dot(r), denominator = a * e - b * b;
  double s = denominator > 1e-12 ? std::clamp((b * f - c * e) / denominator, 0.0, 1.0) : 0.0;
  const double t = std::clamp((b * s + f) / e, 0.0, 1.0);
  s = std::clamp((b * t - c) / a, 0.0, 1.0);
  return (m.a + s * d1 - n.a - t * d2).norm();
}

std::vector<Capsule> capsules(const Figure& f, const BoneTransforms& posed) {
  const double thick = 1.0 + 0.5 * std::max(f.fat, -0.5);
  const auto at = [&](Bone bone, const Vec3& rest) { return Vec3(posed[index(bone)] * rest); };
  const auto joint = [&](Bone bone) { return f.joint[index(bone)]; };
  std::vector<Capsule> list;
  for (const double x : {-0.035, 0.035}) {
    const Vec3 aside(x, 0.0, 0.0);
    list.push_back({at(Bone::kPelvis, joint(Bone::kPelvis) + aside),
                    at(Bone::kSpine, joint(Bone::kSpine) + aside), 0.06 * thick, kTrunkGroup});
    list.push_back({at(Bone::kSpine, joint(Bone::kSpine) + aside),
                    at(Bone::kChest, Vec3(x, f.p.axilla_height, -0.01)), 0.055 * thick, kTrunkGroup});
  }
  list.push_back(
      {at(Bone::kHead, joint(Bone::kHead)), at(Bone::kHead, Vec3(0, 0.95, 0.01)), 0.055, kHeadGroup});
  for (int side = 0; side < 2; ++side) {
    const auto of = [&](Bone left) { return of_side(left, side); };
    const auto start = [&](Bone left) { return at(of(left), joint(of(left))); };
    const Vec3 fingertip =
        at(of(Bone::kFingertipsL), Vec3(joint(of(Bone::kFingertipsL)) + 0.2 * f.p.hand * f.arm[side].along));
    list.push_back({start(Bone::kForearmL), start(Bone::kHandL), 0.022 * thick, kForearmGroup + side});
    list.push_back({start(Bone::kHandL), start(Bone::kFingersL), 0.022, kForearmGroup + side});
    list.push_back({start(Bone::kFingersL), fingertip, 0.02, kForearmGroup + side});
    list.push_back({start(Bone::kUpperArmL), start(Bone::kForearmL), 0.025 * thick, kArmGroup + side});
    const Vec3 middle = 0.5 * (start(Bone::kThighL) + start(Bone::kCalfL));
    list.push_back({middle, start(Bone::kCalfL), 0.04 * thick, kThighGroup + side});
    list.push_back({start(Bone::kCalfL), start(Bone::kFootL), 0.03 * thick, kCalfGroup + side});
    list.push_back({start(Bone::kFootL), start(Bone::kToesL), 0.025, kCalfGroup + side});
  }
  return list;
}

bool may_touch(int a, int b) {
  if (a > b) std::swap(a, b);
  if (a == b) return true;
  if (a == kTrunkGroup)
    return b == kHeadGroup || b == kArmGroup || b == kArmGroup + 1 || b == kThighGroup ||
           b == kThighGroup + 1;
  const bool same_side = (a % 2) == (b % 2);
  if (a == kArmGroup || a == kArmGroup + 1) return same_side && b <= kForearmGroup + 1;
  return (a == kThighGroup || a == kThighGroup + 1) && same_side;
}

}  // namespace

double clearance(const Figure& figure, const BoneTransforms& posed) {
  const std::vector<Capsule> list = capsules(figure, posed);
  double least = 1.0;
  for (std::size_t i = 0; i < list.size(); ++i)
    for (std::size_t k = i + 1; k < list.size(); ++k)
      if (!may_touch(list[i].group, list[k].group))
        least = std::min(least, segment_distance(list[i], list[k]) - list[i].radius - list[k].radius);
  return least;
}

}  // namespace bodice::synth
