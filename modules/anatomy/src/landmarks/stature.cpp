#include "landmarks/stature.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <coefficients/stature.hpp>

namespace bodice::inline v0_1::anatomy {
namespace {

using geometry::Vec3;

/// A body stands when its toes are this level and its height is this near to the estimate; fractions of the
/// stature.
constexpr double kLevelToes = 0.04, kNearEstimate = 0.04;
/// Noise of the skin makes paths along it longer, and the estimate larger. A body stands as well where the
/// line along its middle is this straight.
constexpr double kStraight = 0.95;

double estimate(const BodyCoordinates& coordinates) {
  const auto lengths = stature_lengths(coordinates);
  return std::inner_product(lengths.begin(), lengths.end(), std::begin(coefficients::stature::kLengths), 0.0);
}

/// The distance from crown to ankles by the sum of the straight pieces between the points from one to the
/// other.
double straightness(const Stance& stance) {
  const std::array<Vec3, 5> line = {stance.crown, stance.neck, stance.crotch, stance.knees, stance.ankles};
  double length = 0.0;
  for (std::size_t i = 1; i < line.size(); ++i) length += (line[i] - line[i - 1]).norm();
  return length > 0.0 ? (stance.ankles - stance.crown).norm() / length : 0.0;
}

std::optional<double> height_of(const Stance& stance, const std::vector<Vec3>& points, double estimate) {
  const Vec3 axis = stance.crown - stance.knees;
  if (!(axis.norm() > 0.0)) return std::nullopt;
  const Vec3 up = axis.normalized();
  const double toes_differ = std::abs((stance.toes[0] - stance.toes[1]).dot(up));
  double lowest = std::numeric_limits<double>::infinity();
  for (const Vec3& p : points) lowest = std::min(lowest, (p - stance.crown).dot(up));
  const bool upright = std::abs(-lowest / estimate - 1.0) < kNearEstimate || straightness(stance) > kStraight;
  if (!upright || toes_differ >= kLevelToes * estimate) return std::nullopt;
  return -lowest;
}

/// The top of the head: the tip or, where that lies on hair that stands off, the highest point before this
/// hair. Where the crown lies on hair too, as on a long pony tail, the profile is wrong, and the tip is
/// taken.
Vec3 top_of_head(const Vec3& tip, const Landmarks& marks) {
  const std::optional<HeadProfile>& profile = marks.head_profile;
  const Vec3& crown = marks.at(LandmarkId::kCrown);
  if (!profile || !profile->is_on_hair(tip) || profile->is_on_hair(crown)) return tip;
  const Vec3 up = crown - marks.at(LandmarkId::kPerineum);
  return std::ranges::max(profile->before_hair(), {}, [&](const Vec3& p) { return p.dot(up); });
}

}  // namespace

double stature_of(const Stance& stance, const std::vector<Vec3>& points, double estimate) {
  return height_of(stance, points, estimate).value_or(estimate);
}

std::array<double, 6> stature_lengths(const BodyCoordinates& coordinates) {
  const BodyExtremities& tips = coordinates.extremities();
  const float head_to_hands = 0.5F * ((*tips.from_head)[tips.hand[0]] + (*tips.from_head)[tips.hand[1]]);
  return {tips.head_to_feet,
          tips.feet_apart,
          tips.hands_apart,
          head_to_hands,
          coordinates.front_to_merge_m(),
          coordinates.back_to_merge_m()};
}

std::optional<double> standing_height(const Skin& skin, const BodyCoordinates& coordinates,
                                      const Landmarks& marks, double estimate) {
  const BodyExtremities& tips = coordinates.extremities();
  const auto& p = skin.mesh.positions;
  std::vector<Vec3> own;
  for (std::size_t v = 0; v < p.size(); ++v)
    if (skin.component[v] == 0) own.push_back(p[v]);
  const auto middle = [&](LandmarkId left) { return Vec3(0.5 * (marks.at(left, 0) + marks.at(left, 1))); };
  return height_of({top_of_head(p[tips.head], marks),
                    marks.at(LandmarkId::kNeck),
                    marks.at(LandmarkId::kPerineum),
                    middle(LandmarkId::kKneeL),
                    middle(LandmarkId::kAnkleL),
                    {p[tips.foot[0]], p[tips.foot[1]]}},
                   own, estimate);
}

double find_stature(const Skin& skin, const BodyCoordinates& coordinates, const Landmarks& marks) {
  const double estimated = estimate(coordinates);
  return standing_height(skin, coordinates, marks, estimated).value_or(estimated);
}

}  // namespace bodice::anatomy
