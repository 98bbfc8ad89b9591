#include "landmarks/base/correction.hpp"

#include <algorithm>
#include <cmath>

namespace bodice::anatomy {
namespace {

double weighted_sum(std::span<const double> weights, std::span<const double> measures) {
  double sum = weights[0];
  for (std::size_t i = 0; i < measures.size(); ++i) sum += weights[i + 1] * measures[i];
  return sum;
}

}  // namespace

Corrected corrected(const CorrectionInput& input, std::initializer_list<std::span<const double>> weights,
                    double most) {
  Corrected result{input.first, 0.0};
  geometry::Vec3 shift = geometry::Vec3::Zero();
  double square = 0.0;
  for (std::size_t a = 0; a < input.axes.size(); ++a) {
    const double far = weighted_sum(weights.begin()[a], input.axes[a].measures);
    if (!std::isfinite(far)) return result;
    shift += std::clamp(far, -most, most) * input.axes[a].direction;
    square += far * far;
  }
  result.wanted = std::sqrt(square);
  if (!input.axes.empty()) result.position = input.first + input.size_m * shift;
  return result;
}

void clamp_measures(std::span<double> measures, std::span<const double> least, std::span<const double> most) {
  for (std::size_t i = 0; i < measures.size(); ++i) measures[i] = std::clamp(measures[i], least[i], most[i]);
}

}  // namespace bodice::anatomy
