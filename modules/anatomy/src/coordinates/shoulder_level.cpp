#include "coordinates/shoulder_level.hpp"

#include <algorithm>
#include <cmath>

namespace bodice::inline v0_1::anatomy {
namespace {

/// The ranges of an arm and, within it, of the upper arm: distances from the fingertip as fractions of hand
/// to hand.
constexpr float kFrom = 0.20F, kTo = 0.60F, kUpperArmFrom = 0.27F, kUpperArmTo = 0.35F, kWidensFrom = 0.32F;
constexpr std::size_t kArmSteps = 40;
/// A loop through the armpit is this many times the girth of the upper arm: it takes in the shoulder, and the
/// first of chest and back.
constexpr float kArmpitGirth = 1.7F;
/// The range in which a loop that widens is at an armpit.
constexpr float kAtArmpitFrom = 0.36F, kAtArmpitTo = 0.50F;

float upper_arm_girth(const GirthProfile& profile, float hands_apart) {
  std::vector<float> girths;
  for (std::size_t i = 0; i < kArmSteps; ++i)
    if (profile.level(i) > kUpperArmFrom * hands_apart && profile.level(i) < kUpperArmTo * hands_apart)
      girths.push_back(profile.girth_m[i]);
  const auto middle = girths.begin() + static_cast<std::ptrdiff_t>(girths.size() / 2);
  std::nth_element(girths.begin(), middle, girths.end());
  return *middle;
}

}  // namespace

float shoulder_level(const Skin& skin, std::span<const float> from_hand, float hands_apart) {
  if (!(hands_apart > 0.0F) || !std::isfinite(hands_apart)) return 0.0F;
  const GirthProfile profile =
      girth_profile(skin, from_hand, kFrom * hands_apart, kTo * hands_apart, kArmSteps);
  const float wanted = kArmpitGirth * upper_arm_girth(profile, hands_apart);
  for (std::size_t i = 1; i < kArmSteps; ++i) {
    const float before = profile.girth_m[i - 1], here = profile.girth_m[i];
    if (profile.level(i) < kWidensFrom * hands_apart || !(here > wanted)) continue;
    const float back = here > before ? std::min(1.0F, (here - wanted) / (here - before)) : 0.0F;
    return std::clamp(profile.level(i) - back * profile.step, kAtArmpitFrom * hands_apart,
                      kAtArmpitTo * hands_apart);
  }
  return 0.0F;
}

}  // namespace bodice::anatomy
