#include "landmarks/stature.hpp"

#include <cmath>
#include <limits>

#include <coefficients/stature.hpp>

namespace bodice::inline v0_1::anatomy {
namespace {

using geometry::Vec3;

/// A body stands when its toes are this level and its height is this near to the estimate; fractions of the
/// stature.
constexpr double kLevelToes = 0.04, kNearEstimate = 0.07;
/// Noise of the skin makes paths along it longer, and the estimate larger. A body stands as well where the
/// line along its middle is this straight.
constexpr double kStraight = 0.95;

/// The stature by the distances head to feet, foot to foot, hand to hand and head to hands.
double estimate(const BodyExtremities& tips) {
  const double head_hands = 0.5 * (static_cast<double>((*tips.from_head)[tips.hand[0]]) +
                                   static_cast<double>((*tips.from_head)[tips.hand[1]]));
  const auto& weight = coefficients::stature::kLengths;
  return weight[0] * static_cast<double>(tips.head_to_feet) +
         weight[1] * static_cast<double>(tips.feet_apart) +
         weight[2] * static_cast<double>(tips.hands_apart) + weight[3] * head_hands;
}

/// The distance from crown to ankles by the sum of the straight pieces between the points from one to the
/// other.
double straightness(const Stance& stance) {
  const std::array<Vec3, 5> line = {stance.crown, stance.neck, stance.crotch, stance.knees, stance.ankles};
  double length = 0.0;
  for (std::size_t i = 1; i < line.size(); ++i) length += (line[i] - line[i - 1]).norm();
  return length > 0.0 ? (stance.ankles - stance.crown).norm() / length : 0.0;
}

}  // namespace

double stature_of(const Stance& stance, const std::vector<Vec3>& points, double estimate) {
  const Vec3 axis = stance.crown - stance.knees;
  if (!(axis.norm() > 0.0)) return estimate;
  const Vec3 up = axis.normalized();
  const double toes_differ = std::abs((stance.toes[0] - stance.toes[1]).dot(up));
  double lowest = std::numeric_limits<double>::infinity();
  for (const Vec3& p : points) lowest = std::min(lowest, (p - stance.crown).dot(up));
  const bool upright = std::abs(-lowest / estimate - 1.0) < kNearEstimate || straightness(stance) > kStraight;
  const bool stands = toes_differ < kLevelToes * estimate && upright;
  return stands ? -lowest : estimate;
}

double find_stature(const Skin& skin, const BodyExtremities& tips, const Landmarks& marks) {
  const auto& p = skin.mesh.positions;
  std::vector<Vec3> own;
  for (std::size_t v = 0; v < p.size(); ++v)
    if (skin.component[v] == 0) own.push_back(p[v]);
  const auto middle = [&](LandmarkId left) { return Vec3(0.5 * (marks.at(left, 0) + marks.at(left, 1))); };
  return stature_of({p[tips.head],
                     marks.at(LandmarkId::kNeck),
                     marks.at(LandmarkId::kPerineum),
                     middle(LandmarkId::kKneeL),
                     middle(LandmarkId::kAnkleL),
                     {p[tips.foot[0]], p[tips.foot[1]]}},
                    own, estimate(tips));
}

}  // namespace bodice::anatomy
