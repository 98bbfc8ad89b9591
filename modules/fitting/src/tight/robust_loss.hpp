#pragma once

#include <cstddef>
#include <cstdint>

namespace bodice::fitting {

/// How residuals (union distance - skin distance) are counted. Lengths in units of the scaled problem.
/// Always inlined and without branches, so that loops over samples become vector code (vector_clones.hpp).
struct TightLoss {
  float huber = 0.002f;  ///< squared below, linear above
  float uncovered_huber = 0.002f;
  float uncovered_weight = 1.0f;  ///< of skin and interior that the union leaves outside
  float ignore_depth = 0.008f;    ///< deeper samples that are inside ask nothing
  float far = 0.030f;             ///< samples farther outside ask only not to be nearer than they are

  /// Of a sample at `target` from the skin and `d` from the union; a one-sided one asks only d >= target.
  [[gnu::always_inline]] float cost(float target, bool one_sided, float d) const {
    const bool is_free = (one_sided & (d >= target)) |
                         ((target < -ignore_depth) & (d < -0.5f * ignore_depth)) |
                         ((target > far) & (d > far));
    const float r = __builtin_fabsf(d - target), h = huber_at(target, d);
    const float counted = side(target, d) * (r <= h ? 0.5f * r * r : h * (r - 0.5f * h));
    return is_free ? 0.0f : counted;
  }
  /// Of the squared residual in the normal equations.
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

/// Of n samples at `target` from the skin and `d` from the union. No aliasing.
void count_costs(const TightLoss& loss, std::size_t n, const float* target, const std::uint8_t* one_sided,
                 const float* d, float* cost);

/// Residuals, and their weights in the normal equations.
void weigh(const TightLoss& loss, std::size_t n, const float* target, const float* d, float* residual,
           float* weight);

}  // namespace bodice::fitting
