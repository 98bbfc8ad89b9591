#include "fit_lengths.hpp"

#include <cstdio>

#include "extremities/extremity_template.hpp"
#include "least_squares.hpp"

namespace calibrate {
namespace {

using bodice::anatomy::BodyExtremities;
using bodice::anatomy::kTemplateModes;
using bodice::anatomy::TemplatePairs;

constexpr double kLengthRidge = 1e-9;
/// Rounds of the descent to deviations that are not negative; it has settled long before.
constexpr int kRounds = 2000;
/// The least deviation of a distance, a fraction of the stature: what is left of a mode that made bodies
/// lack.
constexpr double kLeastLengthDeviation = 0.02;

/// Head to feet, foot to foot, hand to hand, head to hands, as fractions of the stature.
Eigen::Vector4d stature_lengths(const Sample& sample) {
  const BodyExtremities& tips = sample.coordinates().extremities();
  const auto& head = *tips.from_head;
  const Eigen::Vector4d lengths(tips.head_to_feet, tips.feet_apart, tips.hands_apart,
                                0.5 * static_cast<double>(head[tips.hand[0]] + head[tips.hand[1]]));
  return lengths / sample.stature_m();
}

/// The distances of the ten pairs, as fractions of the stature.
TemplatePairs pairs_of(const Sample& sample) {
  const BodyExtremities& tips = sample.coordinates().extremities();
  const std::array<const bodice::geodesic::Field*, 5> from{
      tips.from_head, tips.from_hand[0], tips.from_hand[1], tips.from_foot[0], tips.from_foot[1]};
  const std::array<bodice::geometry::Index, 5> tip{tips.head, tips.hand[0], tips.hand[1], tips.foot[0],
                                                   tips.foot[1]};
  TemplatePairs pairs;
  int p = 0;
  for (std::size_t a = 0; a < tip.size(); ++a)
    for (std::size_t b = a + 1; b < tip.size(); ++b)
      pairs[p++] = static_cast<double>((*from[a])[tip[b]]) / sample.stature_m();
  return pairs;
}

/// The variances, none negative, of which the sum of the modes is nearest to the covariance.
Eigen::VectorXd variances_of(const Eigen::MatrixXd& modes, const Eigen::VectorXd& covariance) {
  Eigen::VectorXd variances = Eigen::VectorXd::Zero(modes.cols());
  for (int round = 0; round < kRounds; ++round)
    for (Eigen::Index m = 0; m < modes.cols(); ++m) {
      const Eigen::VectorXd left = covariance - modes * variances + modes.col(m) * variances[m];
      variances[m] = std::max(0.0, modes.col(m).dot(left) / modes.col(m).squaredNorm());
    }
  return variances;
}

}  // namespace

ordered_json fit_stature(const Samples& samples) {
  LeastSquares system(4);
  for (const auto& sample : samples) system.add(stature_lengths(*sample), 1.0);
  const Eigen::VectorXd weights = system.solve(kLengthRidge).col(0);
  double off = 0.0;
  for (const auto& sample : samples) off += std::abs(stature_lengths(*sample).dot(weights) - 1.0);
  std::printf("  stature: %.2f %% off in the mean\n", 100.0 * off / static_cast<double>(samples.size()));
  return {{"lengths", rounded(weights)}};
}

ordered_json fit_extremities(const Samples& samples) {
  TemplatePairs mean = TemplatePairs::Zero();
  double adults = 0.0;
  for (const auto& sample : samples)
    if (sample->adult()) mean += pairs_of(*sample), adults += 1.0;
  mean /= adults;
  const Eigen::VectorXd distances{{0.5 * (mean[0] + mean[1]), 0.5 * (mean[2] + mean[3]), mean[4], mean[9],
                                   0.25 * (mean[5] + mean[6] + mean[7] + mean[8])}};
  const TemplatePairs expected =
      bodice::anatomy::template_pairs(std::span<const double, 5>(distances.data(), 5));
  Eigen::MatrixXd spread = Eigen::MatrixXd::Zero(expected.size(), expected.size());
  for (const auto& sample : samples) {
    const TemplatePairs off = pairs_of(*sample) - expected;
    spread += off * off.transpose() / static_cast<double>(samples.size());
  }
  Eigen::MatrixXd modes(spread.size(), kTemplateModes);
  for (int m = 0; m < kTemplateModes; ++m) {
    std::array<double, kTemplateModes> one{};
    one[static_cast<std::size_t>(m)] = 1.0;
    modes.col(m) = bodice::anatomy::template_spread(one).reshaped();
  }
  const Eigen::VectorXd deviations =
      variances_of(modes, spread.reshaped()).cwiseSqrt().cwiseMax(kLeastLengthDeviation);
  return {{"distances", rounded(distances)}, {"spread", rounded(deviations)}};
}

}  // namespace calibrate
