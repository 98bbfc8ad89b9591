#pragma once

#include <algorithm>
#include <cmath>

namespace bodice::fitting {

/// How residuals (union distance - skin distance) are counted. Lengths in units of the scaled problem.
struct TightLoss {
  float huber = 0.002f;  ///< squared below, linear above
  float uncovered_huber = 0.002f;
  float uncovered_weight = 1.0f;  ///< of skin and interior that the union leaves outside
  float ignore_depth = 0.008f;    ///< deeper samples that are inside ask nothing
  float far = 0.030f;             ///< samples farther outside ask only not to be nearer than they are

  /// Of a sample at `target` from the skin and `d` from the union; a one-sided one asks only d >= target.
  float cost(float target, bool one_sided, float d) const {
    if (one_sided && d >= target) return 0.0f;
    if (target < -ignore_depth && d < -0.5f * ignore_depth) return 0.0f;
    if (target > far && d > far) return 0.0f;
    const float r = std::fabs(d - target), h = huber_at(target, d);
    return side(target, d) * (r <= h ? 0.5f * r * r : h * (r - 0.5f * h));
  }
  /// Of the squared residual in the normal equations.
  float weight(float target, float d) const {
    return side(target, d) * std::min(1.0f, huber_at(target, d) / std::fabs(d - target));
  }

 private:
  static bool is_uncovered(float target, float d) { return target <= 0.0f && d > 0.0f; }
  float huber_at(float target, float d) const { return is_uncovered(target, d) ? uncovered_huber : huber; }
  float side(float target, float d) const { return is_uncovered(target, d) ? uncovered_weight : 1.0f; }
};

}  // namespace bodice::fitting
