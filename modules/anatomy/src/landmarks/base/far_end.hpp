// The second estimate of the ends of the body: what is farthest from the perineum.
#pragma once

#include "landmarks/base/landmarks.hpp"

namespace bodice::inline v0_1::anatomy {

/// Distance from an end to the vertex that is farthest from the perineum among those within `radius` of that
/// end's tip, both as fractions of the body size; -1 if there is none. `from_tip`: distances from that tip.
/// O(#V).
double difference_from_far_end(const LandmarkInput& input, const geodesic::Field& from_tip,
                               const geometry::Vec3& end, float radius);

}  // namespace bodice::anatomy
