// How thick a limb is, level by level, without tracing a single loop.
#pragma once

#include <span>
#include <vector>

#include "skin/skin.hpp"

namespace bodice::inline v0_1::anatomy {

/// Girths of the skin between two levels of a distance field, in equal steps.
struct GirthProfile {
  float from = 0.0F, step = 0.0F;  ///< meters along the skin
  std::vector<float> girth_m;      ///< of the curves between level i and level i + 1, all of them together

  float level(std::size_t i) const { return from + (static_cast<float>(i) + 0.5F) * step; }
};

/// Levels from `from` to `to` in `steps` steps, smoothed over three. Triangles that no source reaches are
/// left out. O(#F + steps).
GirthProfile girth_profile(const Skin& skin, std::span<const float> field, float from, float to,
                           std::size_t steps);

}  // namespace bodice::anatomy
