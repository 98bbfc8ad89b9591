// The template that identifies the extremities of a body by their mutual distances.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "extremities/extremities.hpp"

namespace bodice::inline v0_1::anatomy {

/// The ten pairs of extremities: head and hands, head and feet, hand and hand, hands and feet, foot and foot.
inline constexpr int kTemplatePairs = 10;
using TemplatePairs = Eigen::Matrix<double, kTemplatePairs, 1>;
/// The independent modes in which bodies and poses differ: large heads, long arms, long legs, long trunks,
/// one stretched limb, and noise.
inline constexpr int kTemplateModes = 6;

/// The distance of each pair, from head to hand, head to foot, hand to hand, foot to foot and hand to foot.
TemplatePairs template_pairs(std::span<const double, 5> distances);

/// The covariance of the pairs' distances, from the deviation of each mode.
Eigen::Matrix<double, kTemplatePairs, kTemplatePairs> template_spread(
    std::span<const double, kTemplateModes> deviations);

/// The five candidates that fit the template best.
struct TemplateMatch {
  /// Position in the list of candidates, in the order of Extremity.
  std::array<std::size_t, kExtremityCount> candidate{};
  double mahalanobis = 0.0;
  double size_m = 0.0;  ///< the template's unit: about the stature
};

/// The choice and order of the five candidates with mutual distances that fit the template best; empty if no
/// distance is finite. `apart`: distances of n candidates, n x n, row-major, meters. Cost: O(n^5).
std::optional<TemplateMatch> match_template(std::span<const float> apart, std::size_t n);

}  // namespace bodice::anatomy
