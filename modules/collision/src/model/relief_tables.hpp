// The relief tables of a proxy in the form that the kernels and the exact side read.
// bodice/proxy/proxy_distance.hpp defines the corrected distance and its reaches:
//
//   F_k = d_k - h_k(w) - a_k(w) clamp(d_k, -in, out) / out,   w the unit direction of the closest point
//   F   = sum_k W_k F_k / sum_k W_k,   W_k = max(0, 1 - (d_k - min d) / blend)^2
//
// h and a are interpolated bilinearly on the octahedral map of w (Cigolle et al. 2014). In the poses of a
// bound proxy weights are of the score d_k + kappa b_k in place of d_k (bodice/proxy/posed_proxy.hpp).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <bodice/engine/memory_resource.hpp>
#include <bodice/proxy/body_proxy.hpp>
#include <bodice/proxy/posed_proxy.hpp>

#include "model/baked.hpp"

namespace bodice::inline v0_1::collision {

/// One ellipsoid's table, with scales from bytes to meters (h) and to meters per meter of distance (a / out).
struct alignas(16) BakedTable {
  std::int32_t first_byte = 0;
  std::int32_t nodes = 2;  ///< on each side
  float h_scale_m = 0.0f, h_offset_m = 0.0f;
  float a_scale = 0.0f, a_offset = 0.0f;
  std::int32_t sorted_axis[3] = {0, 1, 2};  ///< index in BakedEllipsoid of the proxy's axes x, y, z
};
inline constexpr int kTableFloats = sizeof(BakedTable) / sizeof(float);

/// Bound on an ellipsoid's distance d_k where its corrected distance F_k is at most m, by the octant of the
/// closest point in the proxy's axes (bits 0, 1, 2: negative along x, y, z):
///   d_k <= at_zero_m[octant] + m (m > 0 ? rise : fall).
/// It is aligned for masked loads, which read whole vectors.
struct alignas(64) OctantReach {
  float at_zero_m[8] = {};
  float rise = 1.0f, fall = 1.0f;
  float shift_m(float m) const { return m * (m > 0.0f ? rise : fall); }
};

/// All relief tables of a proxy, with bounds on what they add.
struct ReliefTables {
  /// `proxy` must have one table an ellipsoid; tables[k] becomes that of ellipsoid order[k].
  /// Texels lie in `memory` if it is not null.
  ReliefTables(const proxy::BodyProxy& proxy, std::span<const std::uint32_t> order,
               engine::MemoryResource* memory);
  /// Replaces the tables by those of a pose of the proxy, of which `stature_m` is that at rest. Reaches are
  /// the same for all octants then. Allocates nothing.
  void update(const proxy::PosedProxy& posed, double stature_m, std::span<const std::uint32_t> order);

  /// Bounds a table anew after its texels or scales have changed. Different tables may be bounded at once.
  void bound_again(std::size_t k);
  /// Finds the bounds that hold for all tables from those of each.
  void bound_all_again();

  std::vector<BakedTable> tables;
  /// Whether the tables are those of a pose, with burial.
  bool buries() const { return burial_m > 0.0f; }

  engine::HostedArray<std::uint8_t> texels;  ///< pairs (h, a); padded, since kernels read two texels at once
  engine::HostedArray<std::uint8_t>
      burial;               ///< one byte a texel, padded likewise; empty: the proxy is not bound
  float burial_m = 0.0f;    ///< kappa times the step of burial; zero: burial does not count
  float deepest_m = 0.0f;   ///< the largest kappa b_k: no score is farther above its distance
  bool sorted_axes = true;  ///< all tables have their axes by falling radius, as BakedEllipsoid has
  float in_m = 0.0f, out_m = 0.0f, blend_m = 0.0f;
  float highest_m = 0.0f;            ///< F_k >= d_k - highest_m for all k
  std::vector<OctantReach> reaches;  ///< one an ellipsoid
  OctantReach farthest;              ///< bound that holds for every ellipsoid
};

}  // namespace bodice::collision
