// The start of the optimization of the anytime tiers: clusters of inscribed balls.
#pragma once

#include "skin/skin_samples.hpp"

namespace bodice::inline v0_1::fitting {

/// The relative number of ellipsoids that a ball's surroundings need: thin limbs need more a square meter
/// than thick ones.
double demand(const InscribedBall& ball, double stature_m);

/// Makes at most `count` ellipsoids for the balls of one part, of at least one ball each. K-means clusters
/// the balls' centers; each ellipsoid has the spread of the skin points that its balls touch. All have the
/// part of the first ball.
std::vector<proxy::ProxyEllipsoid> ellipsoids_from_balls(const engine::Context& context,
                                                         std::span<const InscribedBall> balls, int count,
                                                         double stature_m);

/// The wanted parts' share of at most `count` ellipsoids for the whole body. Each part gets
/// ellipsoids_from_balls(), at least one if it has skin, in proportion to the sum of demand(). If `count` is
/// smaller than the number of parts, the balls of all parts are clustered together.
std::vector<proxy::ProxyEllipsoid> medial_initialization(const engine::Context& context,
                                                         const SkinSource& source, int count);

}  // namespace bodice::fitting
