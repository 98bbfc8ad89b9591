// The relief tables of a proxy as the kernels and the exact side read them. The definition of the corrected
// distance, with its reaches, is in bodice/proxy/proxy_distance.hpp:
//
//   F_k = d_k - h_k(w) - a_k(w) clamp(d_k, -in, out) / out,   w the unit direction of the foot
//   F   = sum_k W_k F_k / sum_k W_k,   W_k = max(0, 1 - (d_k - min d) / blend)^2
//
// h and a are read bilinearly on the octahedral map of w (Cigolle et al. 2014).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <bodice/proxy/body_proxy.hpp>

#include "model/baked.hpp"

namespace bodice::collision {

/// One ellipsoid's table; bytes already scaled to meters (h) and to per meter of distance (a / out).
struct alignas(16) BakedTable {
  std::int32_t first_byte = 0;
  std::int32_t nodes = 2;  ///< per side
  float h_scale_m = 0.0f, h_offset_m = 0.0f;
  float a_scale = 0.0f, a_offset = 0.0f;
  std::int32_t sorted_axis[3] = {0, 1, 2};  ///< where BakedEllipsoid keeps the proxy's axes x, y, z
};
inline constexpr int kTableFloats = sizeof(BakedTable) / sizeof(float);

/// How far from an ellipsoid a corrected distance F_k of m can be found: where F_k <= m and the closest point
/// is in an octant of the proxy's axes (bits 0, 1, 2: negative along x, y, z),
///   d_k <= at_zero_m[octant] + m (m > 0 ? rise : fall).
/// Aligned for masked loads, which read whole vectors.
struct alignas(64) OctantReach {
  float at_zero_m[8] = {};
  float rise = 1.0f, fall = 1.0f;
  float shift_m(float m) const { return m * (m > 0.0f ? rise : fall); }
};

struct ReliefTables {
  /// `proxy` must have tables, one an ellipsoid; tables[k] becomes that of ellipsoid order[k].
  ReliefTables(const proxy::BodyProxy& proxy, std::span<const std::uint32_t> order);

  std::vector<BakedTable> tables;
  std::vector<std::uint8_t> texels;  ///< pairs h, a; padded, since kernels read two texels at a time
  bool sorted_axes = true;           ///< every table's are by falling radius, as BakedEllipsoid has them
  float in_m = 0.0f, out_m = 0.0f, blend_m = 0.0f;
  float highest_m = 0.0f;            ///< F_k >= d_k - highest_m
  std::vector<OctantReach> reaches;  ///< of each
  OctantReach farthest;              ///< not below any of them
};

}  // namespace bodice::collision
