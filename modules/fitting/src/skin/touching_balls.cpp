#include "skin/touching_balls.hpp"

#include "base/vector_clones.hpp"

namespace bodice::inline v0_1::fitting {

constexpr float kTangent = 0.01f;  // squared sine of the least angle to the tangent plane

BODICE_CLONES void touching_radii(const TouchingPoints& points, float most, float* __restrict inward,
                                  float* __restrict outward) {
  const std::size_t n = points.count;
  const float* __restrict x = points.x, * __restrict y = points.y, * __restrict z = points.z;
  const float* __restrict nx = points.nx, * __restrict ny = points.ny, * __restrict nz = points.nz;
  for (std::size_t i = 0; i < n; ++i) inward[i] = outward[i] = most;
  for (std::size_t q = 0; q < n; ++q) {
    const float qx = x[q], qy = y[q], qz = z[q];
    for (std::size_t i = 0; i < n; ++i) {
      const float dx = qx - x[i], dy = qy - y[i], dz = qz - z[i];
      const float squared = dx * dx + dy * dy + dz * dz;
      const float along = dx * nx[i] + dy * ny[i] + dz * nz[i];
      const float radius = 0.5f * squared / (along < 0.0f ? -along : along);
      const bool seen = along * along > kTangent * squared;
      const float in = seen && along < 0.0f ? radius : inward[i];
      const float out = seen && along > 0.0f ? radius : outward[i];
      inward[i] = in < inward[i] ? in : inward[i];
      outward[i] = out < outward[i] ? out : outward[i];
    }
  }
}

}  // namespace bodice::fitting
