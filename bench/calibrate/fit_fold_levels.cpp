#include "fit_fold_levels.hpp"

#include <cstdio>

#include "check/fold_levels.hpp"
#include "least_squares.hpp"

namespace calibrate {
namespace {

using bodice::anatomy::FoldLevels;
using bodice::anatomy::kArmMeasures;
using bodice::anatomy::kLegMeasures;
using bodice::anatomy::MainLandmarks;

constexpr std::array kFoldRidges{1e-7, 1e-6, 1e-5, 1e-4, 1e-3};

std::optional<FoldLevels> levels_of(const Sample& sample) {
  if (!sample.adult() || sample.group() == Group::kRig) return std::nullopt;
  MainLandmarks marks;
  for (std::size_t i = 0; i < marks.size(); ++i) {
    const auto id = static_cast<bodice::body::LandmarkId>(i);
    if (!sample.knows(id)) return std::nullopt;
    marks[i] = sample.landmark(id);
  }
  const FoldLevels levels(marks);
  return levels.known() ? std::optional(levels) : std::nullopt;
}

template <std::size_t n>
Eigen::VectorXd vector_of(const std::array<double, n>& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(n));
}

Eigen::VectorXd solved(const char* name, const FoldedLeastSquares& system) {
  const double ridge = system.best_ridge(kFoldRidges);
  std::printf("  %s: left-out people %.2f %% of the stature off, ridge %g\n", name,
              100.0 * system.left_out_error(ridge), ridge);
  return system.solve(ridge);
}

}  // namespace

ordered_json fit_fold_levels(const Samples& samples) {
  FoldedLeastSquares armpit(kArmMeasures), perineum(kLegMeasures);
  std::size_t bodies = 0;
  for (const Sample* sample : samples) {
    const auto levels = levels_of(*sample);
    if (!levels) continue;
    ++bodies;
    for (int time = 0; time < sample->weight(); ++time) {
      for (int side = 0; side < 2; ++side)
        armpit.add(sample->person(), vector_of(levels->arm_measures(side)), levels->armpit(side));
      perineum.add(sample->person(), vector_of(levels->leg_measures()), levels->perineum());
    }
  }
  std::printf("  %zu of %zu bodies stand with their arms down\n", bodies, samples.size());
  return {{"armpit", rounded(solved("armpit", armpit))}, {"perineum", rounded(solved("perineum", perineum))}};
}

}  // namespace calibrate
