#include "landmarks/stature.hpp"

#include <cmath>

namespace bodice::anatomy {
namespace {

using geometry::Vec3;

/// Least squares over the calibration bodies: head to feet, foot to foot, hand to hand, head to hands.
constexpr double kHeadFeet = 0.258, kFeet = 0.346, kHands = -0.166, kHeadHands = 0.759;
/// A body stands when its toes are this level and its height is this near to the estimate, of the stature.
constexpr double kLevelToes = 0.04, kNearEstimate = 0.07;

double estimate(const BodyExtremities& ends) {
  const double head_hands = 0.5 * (static_cast<double>((*ends.from_head)[ends.hand[0]]) +
                                   static_cast<double>((*ends.from_head)[ends.hand[1]]));
  return kHeadFeet * static_cast<double>(ends.head_to_feet) + kFeet * static_cast<double>(ends.feet_apart) +
         kHands * static_cast<double>(ends.hands_apart) + kHeadHands * head_hands;
}

}  // namespace

double find_stature(const Skin& skin, const BodyExtremities& ends, const Landmarks& marks) {
  const double stature = estimate(ends);
  const auto& p = skin.mesh.positions;
  const Vec3 axis = p[ends.head] - 0.5 * (marks.knee_place[0] + marks.knee_place[1]);
  if (!(axis.norm() > 0.0)) return stature;
  const Vec3 up = axis.normalized();
  const double toes_differ = std::abs((p[ends.foot[0]] - p[ends.foot[1]]).dot(up));
  double lowest = std::numeric_limits<double>::infinity();
  for (std::size_t v = 0; v < p.size(); ++v)
    if (skin.component[v] == 0) lowest = std::min(lowest, (p[v] - p[ends.head]).dot(up));
  const bool stands = toes_differ < kLevelToes * stature && std::abs(-lowest / stature - 1.0) < kNearEstimate;
  return stands ? -lowest : stature;
}

}  // namespace bodice::anatomy
