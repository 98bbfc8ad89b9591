#include "extremities/extremity_template.hpp"

#include <Eigen/Cholesky>
#include <cmath>

#include <coefficients/extremities.hpp>

namespace bodice::inline v0_1::anatomy {
namespace {

using Pairs = TemplatePairs;
constexpr int kPairs = kTemplatePairs;

/// The ten pairs of extremities in a fixed order.
constexpr std::array<std::array<int, 2>, kPairs> kPairOf{
    {{0, 1}, {0, 2}, {0, 3}, {0, 4}, {1, 2}, {1, 3}, {1, 4}, {2, 3}, {2, 4}, {3, 4}}};

/// One independent mode in which bodies and poses differ: the change of each distance at one standard
/// deviation.
Pairs mode(double deviation, const std::array<double, kExtremityCount>& of_end, double trunk = 0.0) {
  Pairs m;
  for (int p = 0; p < kPairs; ++p) {
    const auto [a, b] = kPairOf[p];
    const bool along_trunk = (a < kFootA) != (b < kFootA);
    m[p] = deviation * (of_end[a] + of_end[b] + (along_trunk ? trunk : 0.0));
  }
  return m;
}

/// The reward for larger distances. Of two equal fits the one with larger distances is right, because
/// extremities lie farther out than their neighbors (toe and heel, fingertip and thumb).
constexpr double kFartherIsBetter = 4.0;

}  // namespace

TemplatePairs template_pairs(std::span<const double, 5> distances) {
  const double head_hand = distances[0], head_foot = distances[1], hand_foot = distances[4];
  return Pairs{head_hand, head_hand, head_foot, head_foot, distances[2],
               hand_foot, hand_foot, hand_foot, hand_foot, distances[3]};
}

Eigen::Matrix<double, kPairs, kPairs> template_spread(std::span<const double, kTemplateModes> deviations) {
  const double head = deviations[0], arms = deviations[1], legs = deviations[2], trunk = deviations[3],
               one_limb = deviations[4], noise = deviations[5];
  Eigen::Matrix<double, kPairs, kPairs> spread =
      noise * noise * Eigen::Matrix<double, kPairs, kPairs>::Identity();
  const auto add = [&](const Pairs& m) { spread += m * m.transpose(); };
  add(mode(head, {1, 0, 0, 0, 0}));
  add(mode(arms, {0, 1, 1, 0, 0}));
  add(mode(legs, {0, 0, 0, 1, 1}));
  add(mode(trunk, {0, 0, 0, 0, 0}, 1.0));
  for (int end = kHandA; end < kExtremityCount; ++end) {
    std::array<double, kExtremityCount> one{};
    one[end] = 1.0;
    add(mode(one_limb, one));
  }
  return spread;
}

std::optional<TemplateMatch> match_template(std::span<const float> apart, std::size_t n) {
  // Distances and deviations are fractions of the stature, from bodies of many builds, ages and poses.
  const Pairs expected = template_pairs(coefficients::extremities::kDistances);
  const Eigen::Matrix<double, kPairs, kPairs> weight =
      template_spread(coefficients::extremities::kSpread).inverse();
  std::optional<TemplateMatch> best;
  double best_score = 0.0, longest = 0.0;
  for (const float d : apart)
    if (std::isfinite(d)) longest = std::max(longest, static_cast<double>(d));
  if (!(longest > 0.0)) return std::nullopt;
  const auto consider = [&](const std::array<std::size_t, kExtremityCount>& pick) {
    Pairs d;
    for (int p = 0; p < kPairs; ++p)
      d[p] = static_cast<double>(apart[pick[kPairOf[p][0]] * n + pick[kPairOf[p][1]]]) / longest;
    const Pairs wd = weight * d;
    const double scale = wd.dot(expected) / wd.dot(d);
    if (!(scale > 0.0)) return;
    const Pairs residual = scale * d - expected;
    const double mahalanobis = std::sqrt(std::max(0.0, residual.dot(weight * residual)) / kPairs);
    const double score = mahalanobis - kFartherIsBetter * d.mean();
    if (best && score >= best_score) return;
    best = TemplateMatch{pick, mahalanobis, longest / scale};
    best_score = score;
  };
  for (std::size_t h = 0; h < n; ++h)
    for (std::size_t a = 0; a < n; ++a)
      for (std::size_t b = a + 1; b < n; ++b)
        for (std::size_t c = 0; c < n; ++c)
          for (std::size_t d = c + 1; d < n; ++d)
            if (a != h && b != h && c != h && d != h && c != a && c != b && d != a && d != b)
              consider({h, a, b, c, d});
  return best;
}

}  // namespace bodice::anatomy
