#pragma once

#include <span>
#include <vector>

#include "skin/skin_samples.hpp"

namespace bodice::fitting {

/// Where a union stands in the air: points of its surface that are farther than `gap_m` outside the skin, of
/// about `count` over all ellipsoids, with their distance (at most `most_m`). Samples near the skin do not
/// see an ellipsoid that spreads between two limbs; these do. Deterministic, parallel; about 2 microseconds a
/// point.
std::vector<DistanceSample> samples_in_air(const engine::Context& context, const SkinSource& source,
                                           std::span<const geometry::Ellipsoid> ellipsoids, std::size_t count,
                                           double gap_m, double most_m);

}  // namespace bodice::fitting
