#include "fit_lengths.hpp"

#include <algorithm>
#include <cstdio>

#include "extremities/extremity_template.hpp"
#include "landmarks/stature.hpp"
#include "least_squares.hpp"

namespace calibrate {
namespace {

using bodice::anatomy::BodyExtremities;
using bodice::anatomy::kTemplateModes;
using bodice::anatomy::TemplatePairs;

constexpr double kLengthRidge = 1e-9;
/// Errors of the stature below this count by their square, larger ones by their length; a fraction of it.
constexpr double kSmallStatureError = 0.01;
/// What each group of bodies counts together. Weights could follow the few bodies of files one by one.
constexpr std::array<double, kGroupCount> kStatureWeights{0.3, 0.3, 1.0, 1.0, 1.0};
/// Rounds of the descent to deviations that are not negative; it has settled long before.
constexpr int kRounds = 2000;
/// The least deviation of a distance, a fraction of the stature: what is left of a mode that made bodies
/// lack.
constexpr double kLeastLengthDeviation = 0.02;

/// A body that does not stand, with the lengths that its stature is estimated by, as fractions of that.
struct Unmeasured {
  std::size_t person;
  Group group;
  Eigen::VectorXd lengths;
  double weight = 0.0;
};

/// Those bodies, each once, weighed by their group. Where a body stands, its stature is measured.
std::vector<Unmeasured> unmeasured(Samples samples) {
  samples.erase(std::unique(samples.begin(), samples.end()), samples.end());
  std::vector<Unmeasured> bodies;
  std::array<double, kGroupCount> count{};
  for (const Sample* sample : samples) {
    if (sample->stands()) continue;
    const auto lengths = bodice::anatomy::stature_lengths(sample->coordinates());
    bodies.push_back(
        {sample->person(), sample->group(),
         Eigen::Map<const Eigen::VectorXd>(lengths.data(), lengths.size()) / sample->stature_m()});
    count[static_cast<std::size_t>(sample->group())] += 1.0;
  }
  for (Unmeasured& body : bodies) {
    const auto group = static_cast<std::size_t>(body.group);
    body.weight = kStatureWeights[group] / count[group];
  }
  return bodies;
}

double error(const Unmeasured& body, const Eigen::VectorXd& weights) {
  return std::abs(body.lengths.dot(weights) - 1.0);
}

/// The weights of the least sum of errors by all people but those of a part; kFolds: by all.
Eigen::VectorXd solve(const std::vector<Unmeasured>& bodies, std::size_t without = kFolds) {
  Eigen::VectorXd weights;
  for (int round = 0; round < kReweighted; ++round) {
    LeastSquares system(static_cast<int>(bodies.front().lengths.size()));
    for (const Unmeasured& body : bodies) {
      if (body.person % kFolds == without) continue;
      const double w =
          round == 0 ? body.weight : body.weight / std::max(error(body, weights), kSmallStatureError);
      system.add(body.lengths, 1.0, w);
    }
    weights = system.solve(kLengthRidge).col(0);
  }
  return weights;
}

/// Prints the mean error of each group in percent; `weights_of` (body).
template <class WeightsOf>
void print_errors(const char* what, const std::vector<Unmeasured>& bodies, WeightsOf&& weights_of) {
  std::array<double, kGroupCount> sum{}, count{};
  for (const Unmeasured& body : bodies) {
    sum[static_cast<std::size_t>(body.group)] += error(body, weights_of(body));
    count[static_cast<std::size_t>(body.group)] += 1.0;
  }
  std::printf("    %-16s", what);
  for (std::size_t g = 0; g < kGroupCount; ++g)
    std::printf(" %6.2f", 100.0 * sum[g] / std::max(count[g], 1.0));
  std::printf("\n");
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
  const std::vector<Unmeasured> bodies = unmeasured(samples);
  const Eigen::VectorXd weights = solve(bodies);
  std::vector<Eigen::VectorXd> left_out;
  for (std::size_t fold = 0; fold < kFolds; ++fold) left_out.push_back(solve(bodies, fold));
  std::printf("  stature of %zu bodies that do not stand\n", bodies.size());
  print_errors("estimated", bodies, [&](const Unmeasured&) { return weights; });
  print_errors("left-out people", bodies, [&](const Unmeasured& b) { return left_out[b.person % kFolds]; });
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
