// Based on: the paper, section 2.1 (the perineum halves the path from toe to toe).
// Differs: the path is not traced; its middle is the saddle of the distance from the nearer foot.
#include "coordinates/leg_merge.hpp"

#include <cmath>

namespace bodice::inline v0_1::anatomy {

using geometry::Index;
using geometry::Vec3;

LegMerge find_leg_merge(const Skin& skin, const BodyExtremities& tips) {
  const geodesic::Field &left = *tips.from_foot[0], &right = *tips.from_foot[1];
  LegMerge merge;
  for (std::size_t e = 0; e < skin.edges.ends.size(); ++e) {
    const auto [a, b] = skin.edges.ends[e];
    const float at_a = left[a] - right[a], at_b = left[b] - right[b];
    if (!std::isfinite(at_a) || !std::isfinite(at_b) || (at_a >= 0.0F) == (at_b >= 0.0F)) continue;
    const float t = at_a / (at_a - at_b);
    const float distance = left[a] + t * (left[b] - left[a]);
    if (merge.at.found() && distance >= merge.distance) continue;
    const Vec3 &p = skin.mesh.positions[a], &q = skin.mesh.positions[b];
    merge = {{static_cast<Index>(e), p + static_cast<double>(t) * (q - p)}, distance};
  }
  return merge;
}

}  // namespace bodice::anatomy
