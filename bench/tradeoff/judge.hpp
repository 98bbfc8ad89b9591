// The errors of distances against the exact signed distance.
#pragma once

#include <span>
#include <vector>

namespace tradeoff {

/// Errors over all particles.
struct Error {
  double mean_mm = 0.0, p95_mm = 0.0, max_mm = 0.0;
  double missed_percent = 0.0;  ///< particles deeper than 1 mm that are found outside
  double false_percent = 0.0;   ///< particles more than 1 mm outside that are found inside
};

/// Compares distances; without a sign only absolute values, and none counts as missed or false.
Error judge(std::span<const float> found_m, std::span<const double> truth_m, bool has_sign);

/// The mean of each number over bodies.
Error mean_of(std::span<const Error> errors);

}  // namespace tradeoff
