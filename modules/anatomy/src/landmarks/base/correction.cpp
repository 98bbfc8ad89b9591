#include "landmarks/base/correction.hpp"

#include <algorithm>
#include <cmath>

namespace bodice::inline v0_1::anatomy {
namespace {

double weighted_sum(std::span<const double> weights, std::span<const double> measures) {
  double sum = weights[0];
  for (std::size_t i = 0; i < measures.size(); ++i) sum += weights[i + 1] * measures[i];
  return sum;
}

}  // namespace

std::span<const double> values_of(const LandmarkInput& input, LandmarkId of,
                                  const Coefficients& coefficients) {
  if (!input.records || !input.records->trial) return coefficients.values;
  const auto found = input.records->trial->find({of, coefficients.member});
  return found == input.records->trial->end() ? coefficients.values : std::span<const double>(found->second);
}

void record(const LandmarkInput& input, const Correction& correction) {
  if (input.records) input.records->corrections.push_back(correction);
}

Corrected corrected(const LandmarkInput& input, const Correction& correction) {
  record(input, correction);
  Corrected result{correction.first, 0.0};
  geometry::Vec3 shift = geometry::Vec3::Zero();
  double square = 0.0;
  for (const CorrectionAxis& axis : correction.axes) {
    const double far = weighted_sum(values_of(input, correction.of, axis.weights), axis.measures);
    if (!std::isfinite(far)) return result;
    shift += std::clamp(far, -correction.most, correction.most) * axis.direction;
    square += far * far;
  }
  result.wanted = std::sqrt(square);
  if (!correction.axes.empty()) result.position = correction.first + input.size_m() * shift;
  return result;
}

void limit_measures(const LandmarkInput& input, LandmarkId of, const MeasureLimits& limits,
                    std::span<double> measures) {
  if (input.records) {
    input.records->measured.push_back({of, limits, {measures.begin(), measures.end()}});
    return;
  }
  for (std::size_t i = 0; i < measures.size(); ++i)
    measures[i] = std::clamp(measures[i], limits.least.values[i], limits.most.values[i]);
}

}  // namespace bodice::anatomy
