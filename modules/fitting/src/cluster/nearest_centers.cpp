#include "cluster/nearest_centers.hpp"

#include "base/vector_clones.hpp"

namespace bodice::inline v0_1::fitting {

BODICE_CLONES void nearest_centers(std::size_t n, const float* __restrict x, const float* __restrict y,
                                   const float* __restrict z, std::size_t count,
                                   const std::uint32_t* __restrict which, const float* __restrict centers_xyz,
                                   float* __restrict distance, std::uint32_t* __restrict nearest) {
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
