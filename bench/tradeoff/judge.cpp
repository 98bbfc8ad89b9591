#include "judge.hpp"

#include <algorithm>
#include <cmath>

namespace tradeoff {

Error judge(std::span<const float> found_m, std::span<const double> truth_m, bool has_sign) {
  constexpr double kBeyond_m = 1e-3;
  Error error;
  std::vector<double> off_mm;
  double missed = 0.0, hits = 0.0;
  for (std::size_t i = 0; i < truth_m.size(); ++i) {
    const double found = static_cast<double>(found_m[i]), truth = truth_m[i];
    off_mm.push_back(1e3 * std::abs(has_sign ? found - truth : std::abs(found) - std::abs(truth)));
    missed += has_sign && truth < -kBeyond_m && found > 0.0;
    hits += has_sign && truth > kBeyond_m && found < 0.0;
  }
  if (off_mm.empty()) return error;
  std::sort(off_mm.begin(), off_mm.end());
  const auto count = static_cast<double>(off_mm.size());
  for (const double mm : off_mm) error.mean_mm += mm / count;
  error.p95_mm = off_mm[off_mm.size() * 95 / 100];
  error.max_mm = off_mm.back();
  error.missed_percent = 100.0 * missed / count;
  error.false_percent = 100.0 * hits / count;
  return error;
}

Error mean_of(std::span<const Error> errors) {
  Error mean;
  const auto count = static_cast<double>(errors.size());
  for (const Error& e : errors) {
    mean.mean_mm += e.mean_mm / count, mean.p95_mm += e.p95_mm / count, mean.max_mm += e.max_mm / count;
    mean.missed_percent += e.missed_percent / count, mean.false_percent += e.false_percent / count;
  }
  return mean;
}

}  // namespace tradeoff
