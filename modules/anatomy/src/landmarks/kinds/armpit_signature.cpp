#include "landmarks/kinds/armpit_signature.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <coefficients/armpit.hpp>

#include "coordinates/signature.hpp"
#include "skin/nearest_signature.hpp"
#include "skin/soft_position.hpp"

namespace bodice::inline v0_1::anatomy {
namespace {

using geometry::Index;

/// The signature of an armpit. Its features, in the order of armpit_features():
/// 1 to 3. the distances from its own hand, from the other hand, and from its own foot;
/// 4 to 6. the distances from front, back and perineum;
/// 7. the distance past the shoulder level;
/// 8 and 9. front minus back, and front plus back, as shares of half the chest's girth;
/// 10. the detour of the path between its own hand and foot through the vertex;
/// 11. the distance from the other foot;
/// 12 and 13. the detours between head and hands, and between head and feet;
/// 14. the distance from the head.
/// Six measures of the body predict them: half the chest's girth, the distances between the hands, between
/// the feet, and from perineum to crown, and the distances of the crown from front and back.
constexpr Signature<14, 6> kArmpitSignature = make_signature<14, 6>(
    coefficients::armpit::kMean, coefficients::armpit::kOfBody, coefficients::armpit::kWhiten);

/// The range of the armpit's distance from its own hand; fractions of hand to hand.
constexpr float kSearchFrom = 0.33F, kSearchTo = 0.53F;
/// The largest distances of the armpit from the level where the arm widens, in fractions of hand to hand, and
/// from the shortest path from hand to foot, as a detour.
constexpr float kNearShoulder = 0.075F, kArmpitDetour = 1.13F;
/// Limits of the paths around the chest that count for one side: beyond its forearm, nearer to its own hand,
/// and under the arm. Paths over the neck are shorter on heavy bodies.
constexpr float kChestFrom = 0.30F, kOwnSide = 0.92F, kUnderArm = 1.08F;
constexpr float kLeastHalfChest = 0.02F;  // a fraction of the body size
/// Another vertex counts as elsewhere if it is farther than this from the best one, a fraction of the body
/// size. This is more than a landmark's allowed error. It is less than the distance to the top of the
/// shoulder, the chest or the back, which resemble an armpit.
constexpr double kElsewhere = 0.06;

}  // namespace

float half_chest(const BodyCoordinates& coordinates, int side) {
  const BodyExtremities& tips = coordinates.extremities();
  const geodesic::Field &own = *tips.from_hand[side], &other = *tips.from_hand[1 - side];
  float least = 0.0F;
  for (std::size_t v = 0; v < own.size(); ++v) {
    if (!(own[v] > kChestFrom * tips.hands_apart && own[v] < kOwnSide * other[v])) continue;
    const CoordinateArray x = coordinates.at(v, side);
    if (!(x[kHandFootDetour] < kUnderArm)) continue;
    const float around = x[kFromFront] + x[kFromBack];
    if (least == 0.0F || around < least) least = around;
  }
  return std::max(least, kLeastHalfChest);
}

std::array<float, 6> armpit_measures(const BodyCoordinates& coordinates, float half_chest) {
  const BodyExtremities& tips = coordinates.extremities();
  const float size = coordinates.size_m();
  return {half_chest,
          tips.hands_apart / size,
          tips.feet_apart / size,
          coordinates.from_perineum()[tips.head] / size,
          coordinates.from_front()[tips.head] / size,
          coordinates.from_back()[tips.head] / size};
}

std::array<float, 14> armpit_features(const BodyCoordinates& coordinates, std::size_t v, int side,
                                      float half_chest) {
  const CoordinateArray x = coordinates.at(v, side);
  return {x[kOwnHand],
          x[kOtherHand],
          x[kOwnFoot],
          x[kFromFront],
          x[kFromBack],
          x[kFromPerineum],
          x[kPastShoulder],
          (x[kFromFront] - x[kFromBack]) / half_chest,
          (x[kFromFront] + x[kFromBack]) / half_chest,
          x[kHandFootDetour],
          x[kOtherFoot],
          x[kHeadHandDetour],
          x[kHeadFootDetour],
          x[kFromHead]};
}

bool may_be_armpit(const BodyCoordinates& coordinates, std::size_t v, int side) {
  const geodesic::Field& own = *coordinates.extremities().from_hand[side];
  const float apart = coordinates.extremities().hands_apart;
  if (!(own[v] > kSearchFrom * apart && own[v] < kSearchTo * apart)) return false;
  const CoordinateArray x = coordinates.at(v, side);
  return std::abs(x[kPastShoulder]) < kNearShoulder && x[kHandFootDetour] < kArmpitDetour;
}

ArmpitSignature find_armpit(const engine::Context& context, const Skin& skin,
                            const BodyCoordinates& coordinates, int side) {
  const float half = half_chest(coordinates, side);
  const auto expected = kArmpitSignature.expected(armpit_measures(coordinates, half));
  const auto distance2 = [&](std::size_t v) {
    return kArmpitSignature.distance2(armpit_features(coordinates, v, side, half), expected);
  };
  const auto may_be = [&](std::size_t v) { return may_be_armpit(coordinates, v, side); };
  const NearestSignature found =
      nearest_signature(context, coordinates.from_perineum().size(), may_be, distance2);
  const float least2 = found.mahalanobis * found.mahalanobis;
  const geometry::Vec3 position =
      soft_position(skin, found.vertex, kSoftRadius * static_cast<double>(coordinates.size_m()),
                    [&](Index v) { return may_be(v) ? std::exp(-0.5F * (distance2(v) - least2)) : 0.0F; });
  const double elsewhere = kElsewhere * static_cast<double>(coordinates.size_m());
  const auto may_be_other = [&](std::size_t v) {
    const auto& p = skin.mesh.positions;
    return may_be(v) && (p[v] - p[found.vertex]).squaredNorm() > elsewhere * elsewhere;
  };
  const NearestSignature other =
      nearest_signature(context, coordinates.from_perineum().size(), may_be_other, distance2);
  const float margin = may_be_other(other.vertex) ? other.mahalanobis - found.mahalanobis
                                                  : std::numeric_limits<float>::infinity();
  return {position, found.vertex, found.mahalanobis, margin};
}

}  // namespace bodice::anatomy
