#include "end_template.hpp"

#include <cmath>

namespace bodice::anatomy {
namespace {

/// Distances along the skin as ratios to stature, and how far bodies and poses spread about them (measured on
/// adults of many builds and poses; children have shorter limbs and are covered by the spread).
struct Expected {
  double mean, spread;
};
constexpr Expected kHeadHand{0.64, 0.08}, kHeadFoot{1.09, 0.09}, kHands{0.95, 0.09}, kFeet{1.08, 0.09},
    kHandFoot{1.19, 0.10};

constexpr Expected expected(int a, int b) {
  if (a == kHead) return b <= kHandB ? kHeadHand : kHeadFoot;
  if (a == kHandA && b == kHandB) return kHands;
  return a == kFootA ? kFeet : kHandFoot;
}

/// Ends are further out than their neighbours (toe and heel, fingertip and thumb), so of two equal fits the
/// larger body is the right one.
constexpr double kLargerIsBetter = 1.5;

struct Fit {
  double misfit, size;
};

/// Least squares for the scale, then the root mean square of the weighted residuals.
Fit fit_scale(std::span<const float> apart, std::size_t n, const std::array<std::size_t, kEndCount>& pick) {
  double num = 0.0, den = 0.0, square = 0.0;
  for (int a = 0; a < kEndCount; ++a)
    for (int b = a + 1; b < kEndCount; ++b) {
      const Expected e = expected(a, b);
      const double d = static_cast<double>(apart[pick[a] * n + pick[b]]), w = 1.0 / (e.spread * e.spread);
      num += w * d * e.mean;
      den += w * e.mean * e.mean;
      square += w * d * d;
    }
  const double size = num / den;
  return {size > 0.0 ? std::sqrt(std::max(0.0, square - size * num) / (10.0 * size * size)) : 1e9, size};
}

}  // namespace

std::optional<EndMatch> match_ends(std::span<const float> apart, std::size_t n) {
  std::optional<EndMatch> best;
  double best_score = 0.0, longest = 0.0;
  for (const float d : apart)
    if (std::isfinite(d)) longest = std::max(longest, static_cast<double>(d));
  for (std::size_t h = 0; h < n; ++h)
    for (std::size_t a = 0; a < n; ++a)
      for (std::size_t b = a + 1; b < n; ++b)
        for (std::size_t c = 0; c < n; ++c)
          for (std::size_t d = c + 1; d < n; ++d) {
            if (a == h || b == h || c == h || d == h || c == a || c == b || d == a || d == b) continue;
            const std::array<std::size_t, kEndCount> pick{h, a, b, c, d};
            const Fit fit = fit_scale(apart, n, pick);
            const double score = fit.misfit - kLargerIsBetter * fit.size / longest;
            if (!best || score < best_score) {
              best = EndMatch{pick, fit.misfit, fit.size};
              best_score = score;
            }
          }
  return best;
}

}  // namespace bodice::anatomy
