// Where the optimisation of the anytime tiers starts: clusters of inscribed balls.
#pragma once

#include "skin_samples.hpp"

namespace bodice::fitting {

/// About `count` ellipsoids (never more, at least one a part that has skin unless count is smaller): K-means
/// of the balls' centres part by part, shares by the sum of radius^-0.7, each ellipsoid from the spread of
/// the skin points its balls touch.
std::vector<proxy::ProxyEllipsoid> medial_start(const engine::Context& context, const SkinSource& source,
                                                int count);

}  // namespace bodice::fitting
