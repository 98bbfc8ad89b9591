#include "analyze/tips_of_skin.hpp"

#include <algorithm>

#include "analyze/weld_signs.hpp"

namespace bodice::inline v0_1::anatomy {
namespace {

using body::LandmarkId;

/// Two crowns count as the same if they are nearer than the first fraction of the stature, and two fingertips
/// if they are nearer than the second: a hand without its fingers is shorter by 0.05.
constexpr double kSameCrown = 0.02, kSameHand = 0.06;

void drop_crown_doubts(const Anatomy& as_is, Anatomy& apart) {
  constexpr auto kCrown = static_cast<std::size_t>(LandmarkId::kCrown);
  body::Landmark& crown = apart.landmarks[kCrown];
  const body::Landmark& given = as_is.landmarks[kCrown];
  if ((crown.position - given.position).norm() > kSameCrown * apart.stature_m) return;
  if (std::ranges::any_of(as_is.warnings, is_of_crown)) return;
  std::erase_if(apart.warnings, is_of_crown);
  crown.confidence = given.confidence;
}

bool is_of_nape(const engine::Warning& warning) {
  return warning.code == "nape-covered";
}

void drop_nape_doubts(const Anatomy& as_is, Anatomy& apart) {
  if (!std::ranges::any_of(as_is.warnings, is_of_nape)) std::erase_if(apart.warnings, is_of_nape);
}

void take_fingertips(const Anatomy& as_is, Anatomy& apart) {
  if (limbs_meet(as_is)) return;
  for (const LandmarkId id : {LandmarkId::kFingertipL, LandmarkId::kFingertipR}) {
    body::Landmark& tip = apart.landmarks[static_cast<std::size_t>(id)];
    const body::Landmark& given = as_is.landmarks[static_cast<std::size_t>(id)];
    if ((tip.position - given.position).norm() > kSameHand * apart.stature_m) continue;
    tip.position = given.position;
    tip.vertex = given.vertex;
  }
}

}  // namespace

bool is_of_crown(const engine::Warning& warning) {
  return warning.code == "crown-disagrees";
}

void take_tips(const Anatomy& as_is, Anatomy& apart) {
  drop_crown_doubts(as_is, apart);
  drop_nape_doubts(as_is, apart);
  take_fingertips(as_is, apart);
}

}  // namespace bodice::anatomy
