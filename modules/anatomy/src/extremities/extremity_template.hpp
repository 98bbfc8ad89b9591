// The template that tells a body's ends from each other and from what is not an end.
#pragma once

#include <span>
#include <vector>

#include "extremities/extremities.hpp"

namespace bodice::anatomy {

struct TemplateMatch {
  std::array<std::size_t, kExtremityCount>
      candidate{};  ///< position in the list of candidates, in the order of Extremity
  double mahalanobis = 0.0;
  double size_m = 0.0;  ///< the template's unit: about the stature
};

/// The choice and order of five candidates whose mutual distances fit a body best.
/// `apart`: n x n, row-major, meters.
std::optional<TemplateMatch> match_template(std::span<const float> apart, std::size_t n);

}  // namespace bodice::anatomy
