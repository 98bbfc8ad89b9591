#include "landmarks/base/far_end.hpp"

namespace bodice::inline v0_1::anatomy {

double difference_from_far_end(const LandmarkInput& input, const geodesic::Field& from_tip,
                               const geometry::Vec3& end, float radius) {
  const geodesic::Field& from_perineum = input.coordinates.from_perineum();
  const float reach = radius * input.coordinates.size_m();
  geometry::Index best = geometry::kNoIndex;
  for (std::size_t v = 0; v < from_tip.size(); ++v)
    if (from_tip[v] <= reach && (best == geometry::kNoIndex || from_perineum[v] > from_perineum[best]))
      best = static_cast<geometry::Index>(v);
  if (best == geometry::kNoIndex) return -1.0;
  return (input.skin.mesh.positions[best] - end).norm() / input.size_m();
}

}  // namespace bodice::anatomy
