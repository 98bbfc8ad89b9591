// The template that identifies the extremities of a body by their mutual distances.
#pragma once

#include <span>
#include <vector>

#include "extremities/extremities.hpp"

namespace bodice::anatomy {

/// The five candidates that fit the template best.
struct TemplateMatch {
  std::array<std::size_t, kExtremityCount>
      candidate{};  ///< position in the list of candidates, in the order of Extremity
  double mahalanobis = 0.0;
  double size_m = 0.0;  ///< the template's unit: about the stature
};

/// The choice and order of the five candidates that have mutual distances most like those of a body.
/// `apart`: n x n, row-major, meters.
std::optional<TemplateMatch> match_template(std::span<const float> apart, std::size_t n);

}  // namespace bodice::anatomy
