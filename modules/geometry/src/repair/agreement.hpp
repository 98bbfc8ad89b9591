// When quadrics around a vertex agree with each other and with their points.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "repair/quadric.hpp"

namespace bodice::inline v0_1::geometry {

/// Each fit gives a range of this many of its standard deviations; the ranges of fits that agree meet.
inline constexpr double kAgree = 1.7;

/// The range that a height lies in, as the fits so far have it.
struct HeightRange {
  double low = -std::numeric_limits<double>::infinity(), high = -low;
  /// Narrows it by another fit; false where the two do not meet.
  bool meet(double value, double deviation) {
    low = std::max(low, value - kAgree * deviation);
    high = std::min(high, value + kAgree * deviation);
    return low <= high;
  }
};

/// What noise of a standard deviation lets quadrics be.
class Agreement {
 public:
  Agreement(std::span<const Vec3> positions, double noise)
      : noise_(noise), longest_(bounding_box(positions).size().maxCoeff()) {}

  double deviation(const Quadric::Value& fit) const { return noise_ * std::sqrt(fit.variance); }
  /// No ring is farther.
  double farthest() const { return std::max(kFarthest * longest_, 4.0 * noise_); }
  bool is_certain(const Quadric::Value& fit) const { return deviation(fit) < kCertain * longest_; }
  /// Whether `count` points deviate from the quadric as noise does.
  bool follows(const Quadric::Value& fit, int count) const {
    const double most = kFollows + kFollowsBy * std::sqrt(2.0 / (count - 6));
    return fit.residual < most * noise_ * noise_;
  }

 private:
  /// Rings end at this fraction of the longest side, 10 cm of a person.
  static constexpr double kFarthest = 0.06;
  /// A vertex that is as certain as this fraction of the longest side, .2 mm of a person, needs no more
  /// rings.
  static constexpr double kCertain = 0.00012;
  /// A quadric follows its points where these deviate by less than this, in variances of the noise, and by
  /// less than so many standard deviations of that estimate.
  static constexpr double kFollows = 1.1, kFollowsBy = 2.0;

  double noise_, longest_;
};

}  // namespace bodice::geometry
