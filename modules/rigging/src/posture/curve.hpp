// Based on: F. N. Fritsch, R. E. Carlson. Monotone piecewise cubic interpolation. 1980.
// Differs: slopes are the harmonic means of the secants' slopes, which is simpler and monotone as well.
//
// Smooth curves through a few keys that never overshoot them: a foot that should touch the floor does not
// sink.
#pragma once

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <vector>

namespace bodice::inline v0_1::rigging {

struct CurveKey {
  double at, value;
};

class Curve {
 public:
  enum class Ends { kStill, kPeriodic };

  /// Keys by increasing position. kStill: the first and last values hold outside. kPeriodic: the last key
  /// repeats the first one, and the distance between both is the period.
  Curve(std::initializer_list<CurveKey> keys, Ends ends = Ends::kStill) : keys_(keys), ends_(ends) {
    const std::size_t n = keys_.size();
    slope_.assign(n, 0.0);
    for (std::size_t i = 1; i + 1 < n; ++i) slope_[i] = between(secant(i - 1), secant(i));
    if (ends_ == Ends::kPeriodic && n > 1) slope_.front() = slope_.back() = between(secant(n - 2), secant(0));
  }

  double operator()(double t) const {
    if (ends_ == Ends::kPeriodic) {
      const double period = keys_.back().at - keys_.front().at;
      t -= period * std::floor((t - keys_.front().at) / period);
    }
    if (t <= keys_.front().at) return keys_.front().value;
    if (t >= keys_.back().at) return keys_.back().value;
    std::size_t i = 0;
    while (t >= keys_[i + 1].at) ++i;
    return hermite(i, t);
  }

 private:
  double secant(std::size_t i) const {
    return (keys_[i + 1].value - keys_[i].value) / (keys_[i + 1].at - keys_[i].at);
  }
  static double between(double a, double b) { return a * b > 0.0 ? 2.0 * a * b / (a + b) : 0.0; }
  double hermite(std::size_t i, double t) const {
    const double h = keys_[i + 1].at - keys_[i].at, s = (t - keys_[i].at) / h;
    const double s2 = s * s, s3 = s2 * s;
    return (2.0 * s3 - 3.0 * s2 + 1.0) * keys_[i].value + (s3 - 2.0 * s2 + s) * h * slope_[i] +
           (3.0 * s2 - 2.0 * s3) * keys_[i + 1].value + (s3 - s2) * h * slope_[i + 1];
  }

  std::vector<CurveKey> keys_;
  std::vector<double> slope_;
  Ends ends_;
};

}  // namespace bodice::rigging
