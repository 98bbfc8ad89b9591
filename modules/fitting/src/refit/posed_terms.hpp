// The terms of samples near a posed body: eq. (1) of refit.hpp with the shares of eq. (5').
#pragma once

#include <bodice/fitting/refit.hpp>

#include "relief/relief_terms.hpp"

namespace bodice::inline v0_1::fitting {

/// Finds the terms of all samples. Their shares hold the scale of the ellipsoid, and their targets what has
/// grown. Deterministic, parallel. One to two microseconds a sample.
ReliefTerms find_posed_terms(const engine::Context& context, std::span<const ReliefSample> samples,
                             const RefitInput& input);

}  // namespace bodice::fitting
