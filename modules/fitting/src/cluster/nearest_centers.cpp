#include "cluster/nearest_centers.hpp"

#include "base/vector_clones.hpp"

namespace bodice::inline v0_1::fitting {

BODICE_CLONES void nearest_centers(const PointArrays& points, std::span<const std::uint32_t> candidates,
                                   const float* centers_xyz, float* __restrict distance,
                                   std::uint32_t* __restrict nearest) {
  const std::size_t n = points.count, count = candidates.size();
  const std::uint32_t* const which = candidates.data();
  const float *const x = points.x, *const y = points.y, *const z = points.z;
  for (std::size_t i = 0; i < n; ++i) distance[i] = __builtin_inff(), nearest[i] = 0;
  for (std::size_t m = 0; m < count; ++m) {
    const std::uint32_t k = which[m];
    const float cx = centers_xyz[3 * k], cy = centers_xyz[3 * k + 1], cz = centers_xyz[3 * k + 2];
    for (std::size_t i = 0; i < n; ++i) {
      const float dx = x[i] - cx, dy = y[i] - cy, dz = z[i] - cz;
      const float d = dx * dx + dy * dy + dz * dz;
      nearest[i] = d < distance[i] ? k : nearest[i];
      distance[i] = d < distance[i] ? d : distance[i];
    }
  }
}

}  // namespace bodice::fitting
