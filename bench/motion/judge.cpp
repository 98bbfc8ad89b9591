#include "judge.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace bench {
namespace {

constexpr double kWrong_m = 1e-3;

Spread_mm spread(std::vector<double> values) {
  if (values.empty()) return {};
  std::ranges::sort(values);
  const auto count = static_cast<double>(values.size());
  return {std::accumulate(values.begin(), values.end(), 0.0) / count,
          values[static_cast<std::size_t>(0.95 * (count - 1.0))], values.back()};
}

double percent(std::size_t part, std::size_t whole) {
  return whole == 0 ? 0.0 : 100.0 * static_cast<double>(part) / static_cast<double>(whole);
}

}  // namespace

void Judge::add(const Truth& truth, std::span<const float> distance_m) {
  std::vector<double> errors;
  for (std::size_t i = 0; i < truth.particles.size(); ++i) {
    const double s = truth.distance_m[i], d = double{distance_m[i]};
    if (i < truth.near_skin) {
      errors.push_back(1e3 * std::abs(d - s));
      missed_ += s < -kWrong_m && d > 0.0;
      false_ += s > kWrong_m && d < 0.0;
      if (errors.back() > worst_mm_)
        worst_mm_ = errors.back(), worst_point_ = truth.particles.at(i), worst_frame_ = frames_.size();
    } else if (i < truth.near_skin + truth.on_skin) {
      (d < 0.0 ? over_ : under_).push_back(1e3 * std::abs(d));
    } else {
      ++interior_;
      covered_ += d <= 0.0;
    }
  }
  frames_.push_back(spread(errors));
  errors_.insert(errors_.end(), errors.begin(), errors.end());
}

Spread_mm Judge::error() const {
  return spread(errors_);
}
Spread_mm Judge::protrusion() const {
  return spread(over_);
}
Spread_mm Judge::gap() const {
  return spread(under_);
}
double Judge::missed_percent() const {
  return percent(missed_, errors_.size());
}
double Judge::false_percent() const {
  return percent(false_, errors_.size());
}
double Judge::coverage_percent() const {
  return percent(covered_, interior_);
}

}  // namespace bench
