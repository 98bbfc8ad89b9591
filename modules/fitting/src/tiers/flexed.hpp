// Tight ellipsoids of a body that will move, found on its flexed skin.
#pragma once

#include "tiers/tiers.hpp"

namespace bodice::inline v0_1::fitting {

/// The ellipsoids of fit_tight(), but found on `options.flexed`, the same skin with its joints half bent, and
/// carried back to the skin as it is: each ellipsoid by the affine map that takes the skin it stands for
/// there best. None then spans a joint.
Draft fit_tight_flexed(const engine::Context& context, const SkinSource& source, const FitOptions& options,
                       int count, double time_budget_s);

}  // namespace bodice::fitting
