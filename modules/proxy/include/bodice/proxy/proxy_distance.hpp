// The definition of a proxy's signed distance, in double precision. Fitting minimizes its error, reports are
// measured with it, and every faster evaluation has to agree with it.
//
// For a point x and ellipsoid k (center c, axes R, radii r):
//   (1)  d_k   exact signed distance to the ellipsoid's surface, negative inside; f_k its closest point
//   (2)  w_k   = R^T (f_k - c) / r, component by component: a unit vector, f_k on the unit sphere
//   (3)  F_k   = d_k - h_k(w_k) - a_k(w_k) clamp(d_k, -reach.in, reach.out) / reach.out  (no table: d_k)
//   (4)  owner = argmin_k d_k, the lowest index on a tie
//   (5)  F     = d_owner - margin                                                        (no tables)
//        F     = sum_k W_k F_k / sum_k W_k - margin                                      (relief)
//        W_k   = max(0, 1 - (d_k - d_owner) / reach.blend)^2
// (5) is continuous: W_k falls to zero, with its slope, before k leaves the blend. Only the medial disks of
// the ellipsoids, deep inside, are left, where the closest point is not unique. reach scales with the
// stature, so that a proxy in another unit is the same proxy: relief_reach().
//
// The table is read at w by the octahedral map. With s = |w_x| + |w_y| + |w_z|, p = (w_x, w_y) / s; where
// w_z < 0, p = ((1 - |p_y|) sign(p_x), (1 - |p_x|) sign(p_y)), sign(0) = +1. Nodes lie on a grid of N x N
// over [-1, 1]^2, row-major with x fastest: node (i, j) at p = (2 i / (N-1) - 1, 2 j / (N-1) - 1), texel
// first_texel + j N + i. N may differ from ellipsoid to ellipsoid. Read bilinearly. Writers give border
// nodes that map to the same direction the same bytes ((i, 0) = (N-1-i, 0), (i, N-1) = (N-1-i, N-1),
// (0, j) = (0, N-1-j), (N-1, j) = (N-1, N-1-j), the four corners alike), so that readers need no special
// case and h, a are continuous on the sphere.
// Source of the map: Cigolle et al. A Survey of Efficient Representations for Independent Unit Vectors. 2014.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <bodice/proxy/body_proxy.hpp>

namespace bodice::inline v0_1::proxy {

using geometry::Vec3;

/// The lengths of eq. (3) and (5), meters.
struct ReliefReach {
  double in_m = 0.0, out_m = 0.0, blend_m = 0.0;
};

/// The reach for a body of the given stature: 30 mm inward, 30 mm outward and 3 mm of blending at 1.70 m, and
/// in proportion for others.
ReliefReach relief_reach(double stature_m);

/// The position of a unit direction on the square [-1, 1]^2.
std::array<double, 2> octahedral_map(const Vec3& direction);
/// The unit direction of a position on the square; the inverse of octahedral_map().
Vec3 octahedral_direction(double x, double y);

/// The four nodes around a direction and their bilinear weights (they sum to 1).
struct TableStencil {
  std::array<std::uint32_t, 4> node;  ///< row-major, relative to first_texel
  std::array<double, 4> weight;
};
/// The stencil of a unit direction in a table of at least two nodes a side.
TableStencil table_stencil(const Vec3& direction, int nodes_per_side);

/// The proxy's distance at a point, with its gradient and owner.
struct ProxyDistance {
  double distance = 0.0;        ///< F, meters, negative inside
  Vec3 normal = Vec3::UnitX();  ///< unit gradient of F, with the weights W_k held fixed
  std::uint32_t owner = 0;      ///< eq. (4)
};

/// Evaluates F at one point. Exact and slow: O(#ellipsoids), some microseconds for a body. Thread-safe. A
/// proxy without ellipsoids is infinitely far.
ProxyDistance proxy_distance(const BodyProxy& proxy, const Vec3& point);

/// Evaluates F on data that are not a BodyProxy yet, with the same bits.
ProxyDistance proxy_distance(const BodyProxy::Data& data, const Vec3& point);

}  // namespace bodice::proxy
