// Where the optimization of the anytime tiers starts: clusters of inscribed balls.
#pragma once

#include "skin/skin_samples.hpp"

namespace bodice::fitting {

/// How many ellipsoids a ball's surroundings ask for: thin places need more a square meter than thick ones.
double demand(const InscribedBall& ball, double stature_m);

/// At most `count` ellipsoids for one part's balls (at least one ball): K-means of the balls' centers, each
/// ellipsoid from the spread of the skin points that its balls touch. They carry the first ball's part.
std::vector<proxy::ProxyEllipsoid> start_from_balls(const engine::Context& context,
                                                    std::span<const InscribedBall> balls, int count,
                                                    double stature_m);

/// The wanted parts' share of about `count` ellipsoids for the whole body (never more, at least one a part
/// that has skin unless count is smaller): K-means of the balls' centers part by part, shares by the sum of
/// radius^-0.7, each ellipsoid from the spread of the skin points its balls touch. With fewer than the body
/// has parts, all balls are clustered together.
std::vector<proxy::ProxyEllipsoid> medial_start(const engine::Context& context, const SkinSource& source,
                                                int count);

}  // namespace bodice::fitting
