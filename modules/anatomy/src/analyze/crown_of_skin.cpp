#include "analyze/crown_of_skin.hpp"

#include <algorithm>

namespace bodice::inline v0_1::anatomy {
namespace {

using body::LandmarkId;

/// A crown that moves by less than this share of the stature is the same one.
constexpr double kSameCrown = 0.02;

bool is_of_crown(const engine::Warning& w) {
  return w.code == "crown-disagrees";
}

}  // namespace

void judge_crown(const Anatomy& as_is, Anatomy& apart) {
  constexpr auto kCrown = static_cast<std::size_t>(LandmarkId::kCrown);
  body::Landmark& crown = apart.landmarks[kCrown];
  const body::Landmark& given = as_is.landmarks[kCrown];
  if ((crown.position - given.position).norm() > kSameCrown * apart.stature_m) return;
  if (std::ranges::any_of(as_is.warnings, is_of_crown)) return;
  std::erase_if(apart.warnings, is_of_crown);
  crown.confidence = given.confidence;
}

}  // namespace bodice::anatomy
