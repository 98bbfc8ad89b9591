// A bound proxy in one pose, and its signed distance: the scalar double reference that posing is judged with
// and that faster evaluations have to agree with.
//
// Equations (1) to (3) of proxy_distance.hpp hold with the pose's ellipsoids and tables. Tables say besides
// how deep the surface lies under other ellipsoids in the rest pose, the burial b_k(w): what was buried at
// rest was fitted to nothing, and must yield where a pose brings it to the skin. So
//   (4')  owner = argmin_k ( d_k + kappa b_k(w_k) ),  the lowest index on a tie
//   (5')  F     = sum_k W_k F_k / sum_k W_k - margin
//         W_k   = max(0, 1 - (d_k + kappa b_k - d_owner - kappa b_owner) / reach.blend)^2
// A pose may raise the burial of texels that their skin has left (binding/src/pose/yield.hpp).
// Burial counts from reach.blend on, so that outside of the ellipsoids of a body at rest (5') is (5), but for
// cells of a table between a texel that is buried and one that is not: hundredths of a millimeter on average.
// As b_k >= 0, a lower bound on d_k bounds the left side of (4') as well. A body of another size is the same
// body: reach, margin and burial scale with PosedProxy::scale.
#pragma once

#include <cstdint>
#include <vector>

#include <bodice/proxy/proxy_distance.hpp>

namespace bodice::inline v0_1::proxy {

/// kappa of eq. (4'), no unit. Two to three serve alike; with more, ellipsoids yield that still are right.
inline constexpr double kBurialWeight = 2.0;

/// One pose of a bound proxy: the same number of ellipsoids, tables and texels in the same order.
struct PosedProxy {
  std::vector<geometry::Ellipsoid> shapes;  ///< #E, world, meters
  /// #E: the material point that was at center + axes diag(radii) u at rest is at center + material u now.
  /// The axes of an ellipsoid alone do not show it, since they may swap from pose to pose.
  std::vector<geometry::Mat3> material;
  std::vector<ReliefTable> relief;   ///< #E
  std::vector<ReliefTexel> texels;   ///< #X
  std::vector<std::uint8_t> burial;  ///< #X, in units of burial_step_m
  float burial_step_m = 0.0f;
  double scale = 1.0;  ///< size of the body over its size at rest
};

/// F of eq. (5') at one point, its normal and owner. Exact and slow: O(#E). Thread-safe. `bound` is the proxy
/// that was posed.
ProxyDistance posed_proxy_distance(const BodyProxy& bound, const PosedProxy& posed, const Vec3& point);

}  // namespace bodice::proxy
