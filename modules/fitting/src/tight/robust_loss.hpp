// The cost of a residual: squared where it is small, linear where it is large.
// Based on: Peter J. Huber. Robust Estimation of a Location Parameter. 1964.
#pragma once

#include <cstddef>
#include <cstdint>

namespace bodice::inline v0_1::fitting {

/// The cost of residuals, which are union distance less skin distance. Lengths are those of the scaled body.
/// Functions are always inlined and have no branches, so that loops over samples become vector code
/// (vector_clones.hpp).
struct RobustLoss {
  float huber = 0.002f;            ///< residuals are squared below this and linear above
  float uncovered_huber = 0.002f;  ///< the same for skin and interior that the union leaves outside
  float uncovered_weight = 1.0f;   ///< weight of skin and interior that the union leaves outside
  float ignore_depth = 0.008f;     ///< a deeper sample costs nothing if it is inside
  float far = 0.030f;              ///< a sample farther outside costs nothing if the union is that far, too

  /// The cost of a sample at distance `target` from the skin and `d` from the union. A one-sided sample costs
  /// nothing if d >= target.
  [[gnu::always_inline]] float cost(float target, bool one_sided, float d) const {
    const bool is_free = (one_sided & (d >= target)) |
                         ((target < -ignore_depth) & (d < -0.5f * ignore_depth)) |
                         ((target > far) & (d > far));
    const float r = __builtin_fabsf(d - target), h = huber_at(target, d);
    const float counted = side(target, d) * (r <= h ? 0.5f * r * r : h * (r - 0.5f * h));
    return is_free ? 0.0f : counted;
  }
  /// The weight of the squared residual in the normal equations.
  [[gnu::always_inline]] float weight(float target, float d) const {
    const float r = __builtin_fabsf(d - target), h = huber_at(target, d);
    return side(target, d) * (r <= h ? 1.0f : h / r);
  }

 private:
  [[gnu::always_inline]] static bool is_uncovered(float target, float d) {
    return (target <= 0.0f) & (d > 0.0f);
  }
  [[gnu::always_inline]] float huber_at(float target, float d) const {
    return is_uncovered(target, d) ? uncovered_huber : huber;
  }
  [[gnu::always_inline]] float side(float target, float d) const {
    return is_uncovered(target, d) ? uncovered_weight : 1.0f;
  }
};

/// Writes the costs of n samples at distances `target` from the skin and `d` from the union. No arrays
/// overlap.
void count_costs(const RobustLoss& loss, std::size_t n, const float* target, const std::uint8_t* one_sided,
                 const float* d, float* cost);

/// Writes the residuals of n samples and their weights in the normal equations. No arrays overlap.
void weigh(const RobustLoss& loss, std::size_t n, const float* target, const float* d, float* residual,
           float* weight);

}  // namespace bodice::fitting
