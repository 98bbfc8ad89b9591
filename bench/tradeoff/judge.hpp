// How far answers are off the exact signed distance.
#pragma once

#include <span>
#include <vector>

namespace tradeoff {

struct Error {
  double mean_mm = 0.0, p95_mm = 0.0, max_mm = 0.0;
  double missed_percent = 0.0;  ///< of all: deeper than 1 mm but called outside
  double false_percent = 0.0;   ///< of all: over 1 mm outside but called inside
};

/// Without a sign only the distances are compared, and nothing counts as missed or false.
Error judge(std::span<const float> found_m, std::span<const double> truth_m, bool has_sign);

/// The mean of each number over bodies.
Error mean_of(std::span<const Error> errors);

}  // namespace tradeoff
