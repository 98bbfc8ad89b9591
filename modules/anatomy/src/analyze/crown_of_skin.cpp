#include "analyze/crown_of_skin.hpp"

#include <algorithm>

namespace bodice::inline v0_1::anatomy {
namespace {

using body::LandmarkId;

/// Two crowns count as the same if they are nearer than this fraction of the stature.
constexpr double kSameCrown = 0.02;

bool is_of_crown(const engine::Warning& w) {
  return w.code == "crown-disagrees";
}

}  // namespace

void drop_crown_doubts(const Anatomy& as_is, Anatomy& apart) {
  constexpr auto kCrown = static_cast<std::size_t>(LandmarkId::kCrown);
  body::Landmark& crown = apart.landmarks[kCrown];
  const body::Landmark& given = as_is.landmarks[kCrown];
  if ((crown.position - given.position).norm() > kSameCrown * apart.stature_m) return;
  if (std::ranges::any_of(as_is.warnings, is_of_crown)) return;
  std::erase_if(apart.warnings, is_of_crown);
  crown.confidence = given.confidence;
}

}  // namespace bodice::anatomy
