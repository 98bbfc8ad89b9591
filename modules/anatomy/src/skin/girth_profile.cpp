// Based on: Herbert Federer. Curvature measures. 1959. - the coarea formula: where a field grows by one meter
// a meter, the skin's area between two levels is the length of the curves between them times the step.
#include "skin/girth_profile.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace bodice::inline v0_1::anatomy {
namespace {

/// Share of a triangle below a level, for a field that is linear on it; corners sorted.
float share_below(const std::array<float, 3>& corner, float level) {
  const auto [a, b, c] = corner;
  if (level <= a) return 0.0F;
  if (level >= c) return 1.0F;
  if (level < b) return (level - a) * (level - a) / ((b - a) * (c - a));
  return 1.0F - (c - level) * (c - level) / ((c - a) * (c - b));
}

std::vector<float> smoothed(const std::vector<float>& values) {
  std::vector<float> result = values;
  for (std::size_t i = 1; i + 1 < values.size(); ++i)
    result[i] = 0.25F * values[i - 1] + 0.5F * values[i] + 0.25F * values[i + 1];
  return result;
}

}  // namespace

GirthProfile girth_profile(const Skin& skin, std::span<const float> field, float from, float to,
                           std::size_t steps) {
  GirthProfile profile{from, (to - from) / static_cast<float>(steps), std::vector<float>(steps, 0.0F)};
  if (!(profile.step > 0.0F)) return profile;
  for (std::size_t f = 0; f < skin.mesh.triangles.size(); ++f) {
    const auto& t = skin.mesh.triangles[f];
    std::array<float, 3> corner{field[t[0]], field[t[1]], field[t[2]]};
    const auto [low, high] = std::minmax({corner[0], corner[1], corner[2]});
    if (!(low < to && high > from && std::isfinite(high))) continue;
    std::sort(corner.begin(), corner.end());
    const auto area = static_cast<float>(0.5 * geometry::area_vector(skin.mesh, f).norm());
    const auto first = static_cast<std::size_t>(std::max(0.0F, (low - from) / profile.step));
    float below = share_below(corner, from + static_cast<float>(first) * profile.step);
    for (std::size_t i = first; i < steps && below < 1.0F; ++i) {
      const float next = share_below(corner, from + static_cast<float>(i + 1) * profile.step);
      profile.girth_m[i] += area * (next - below) / profile.step;
      below = next;
    }
  }
  profile.girth_m = smoothed(profile.girth_m);
  return profile;
}

}  // namespace bodice::anatomy
