// Samples that the tables of tier relief are fitted to: along the normals of even skin points, and inside the
// body.
#pragma once

#include <span>
#include <vector>

#include "skin/free_skin.hpp"

namespace bodice::inline v0_1::fitting {

/// A point with its distance to the skin.
struct ReliefSample {
  Vec3 point;
  double signed_distance_m = 0.0;  ///< to the skin that bounds the body, negative inside
  float weight = 0.0f;
};

/// How samples along normals are drawn.
struct ReliefSampling {
  std::size_t normals = 0;  ///< number of skin points
  int per_normal = 1;       ///< samples a skin point, one in each of so many equal stretches of its normal
  double reach_m = 0.0;     ///< the stretches cover the normal from reach_m inside to reach_m outside
  std::uint64_t seed = 0;
};

/// Samples along the normals of the wanted skin. Deterministic, parallel. A third of a microsecond a sample
/// where the skin is smooth, 2 microseconds where it is not.
std::vector<ReliefSample> sample_along_normals(const engine::Context& context, const FreeSkin& skin,
                                               const ReliefSampling& sampling);

/// Samples on a grid inside the body. They keep the holes between ellipsoids closed: behind creases normals
/// fan out and miss the depth. Deeper than reach_m the distance is -reach_m. O(#F + points).
std::vector<ReliefSample> sample_inside(const engine::Context& context, const FreeSkin& skin,
                                        double spacing_m, double reach_m);

/// Samples around `points`, where tables leaked: each point itself and 47 more within `radius_m` of it, at a
/// quarter of the weight.
std::vector<ReliefSample> sample_around(const engine::Context& context, const FreeSkin& skin,
                                        std::span<const Vec3> points, double radius_m, double reach_m);

}  // namespace bodice::fitting
