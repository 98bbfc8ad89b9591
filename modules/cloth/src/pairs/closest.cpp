// may_meet() is based on: Minchen Li, Danny M. Kaufman, Chenfanfu Jiang. Codimensional Incremental Potential
// Contact. 2021. - section 5 (additive continuous collision detection)
#include "pairs/closest.hpp"

#include <algorithm>
#include <cmath>

#include "base/tolerances.hpp"

namespace bodice::inline v0_1::cloth {
namespace {

constexpr int kMostAdvances = 24;  // steps along a path; if they do not suffice, may_meet() returns true
constexpr float kAdvance = 0.9f;   // share of the safe path that a step takes, for rounding

Closest of_weights(const Corners& c, Float4 weight) {
  const Float4 apart =
      xyz(weight[0] * c.at[0] + weight[1] * c.at[1] + weight[2] * c.at[2] + weight[3] * c.at[3]);
  return {weight, apart, dot(apart, apart)};
}

float clamped(float value) {
  return std::clamp(value, 0.0f, 1.0f);
}

}  // namespace

Closest closest_on_triangle(const Corners& corners) {
  const auto& [p, a, b, c] = corners.at;
  const Float4 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
  const auto at = [&](float u, float v, float w) { return of_weights(corners, Float4{1.0f, -u, -v, -w}); };
  const float d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= 0.0f && d2 <= 0.0f) return at(1.0f, 0.0f, 0.0f);
  const float d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0.0f && d4 <= d3) return at(0.0f, 1.0f, 0.0f);
  const float vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0f && d1 >= 0.0f && d3 <= 0.0f) {
    const float v = d1 / (d1 - d3);
    return at(1.0f - v, v, 0.0f);
  }
  const float d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0.0f && d5 <= d6) return at(0.0f, 0.0f, 1.0f);
  const float vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0f && d2 >= 0.0f && d6 <= 0.0f) {
    const float w = d2 / (d2 - d6);
    return at(1.0f - w, 0.0f, w);
  }
  const float va = d3 * d6 - d5 * d4;
  if (va <= 0.0f && d4 >= d3 && d5 >= d6) {
    const float w = (d4 - d3) / (d4 - d3 + d5 - d6 + kTinyLength2);
    return at(0.0f, 1.0f - w, w);
  }
  const float all = va + vb + vc;
  return all > 0.0f ? at(va / all, vb / all, vc / all) : at(1.0f, 0.0f, 0.0f);
}

Closest closest_of_edges(const Corners& corners) {
  const Float4 *const at = corners.at, along_a = at[1] - at[0], along_b = at[3] - at[2], r = at[0] - at[2];
  const float a = dot(along_a, along_a) + kTinyLength2, e = dot(along_b, along_b) + kTinyLength2;
  const float b = dot(along_a, along_b), c = dot(along_a, r), f = dot(along_b, r);
  const float across = a * e - b * b;  // zero for parallel edges, where any point of A will serve
  float s = across > 1e-6f * a * e ? clamped((b * f - c * e) / across) : 0.5f;
  float t = (b * s + f) / e;
  if (t < 0.0f) {
    t = 0.0f, s = clamped(-c / a);
  } else if (t > 1.0f) {
    t = 1.0f, s = clamped((b - c) / a);
  }
  return of_weights(corners, Float4{1.0f - s, s, t - 1.0f, -t});
}

bool may_meet(bool edges, Corners from, const Corners& by, float least_m) {
  Corners path;
  const Float4 mean = 0.25f * (by.at[0] + by.at[1] + by.at[2] + by.at[3]);
  float longest[2] = {0.0f, 0.0f};
  for (int k = 0; k < 4; ++k) {
    path.at[k] = xyz(by.at[k] - mean);
    float& of_part = longest[edges ? k / 2 : std::min(k, 1)];
    of_part = std::max(of_part, dot(path.at[k], path.at[k]));
  }
  const float speed = std::sqrt(longest[0]) + std::sqrt(longest[1]);  // meters over the whole path
  float done = 0.0f;
  for (int step = 0; step < kMostAdvances; ++step) {
    const float room_m = std::sqrt(closest(edges, from).length2) - least_m;
    if (!(room_m > 0.0f)) return true;
    if (room_m > speed * (1.0f - done)) return false;
    const float advance = std::min(kAdvance * room_m / speed, 1.0f - done);
    for (int k = 0; k < 4; ++k) from.at[k] += advance * path.at[k];
    done += advance;
  }
  return true;
}

}  // namespace bodice::cloth
