// Binding: what carries a proxy along with the joints of a rig is computed once.
//
// Every ellipsoid k gets constant matrices M_kj, such that in a pose with skinning matrices T_j
//  (1) A_k = sum_j T_j M_kj is the affine map that takes the skin which the ellipsoid stands for from rest to
// the pose best (weighted least squares, drawn a little to the blend of its joints). Under linear blend
// skinning this holds in every pose, since both sides of the normal equations are linear in T. What an affine
// map cannot follow, the tables do: (2) each texel near the skin stores the skin point at its surface and the
// joints that move it, and (3) each texel stores how deep its surface point lies under other ellipsoids
// (proxy/posed_proxy.hpp).
#pragma once

#include <bodice/body/part.hpp>
#include <bodice/engine/context.hpp>
#include <bodice/engine/result.hpp>
#include <bodice/geometry/tri_mesh.hpp>
#include <bodice/proxy/body_proxy.hpp>
#include <bodice/rig/skeleton.hpp>
#include <bodice/rig/skinning.hpp>

namespace bodice::inline v0_1::binding {

using geometry::Mat3;
using geometry::Vec3;

/// The skin that a proxy was fitted to, in the bind pose, and what moves it.
struct SkinnedBody {
  const geometry::TriMesh& skin;    ///< meters, y up
  const rig::Skeleton& skeleton;    ///< valid
  const rig::SkinWeights& weights;  ///< mended, of the skin's vertices
  /// #V: the limb of each vertex. With limbs, binding bends them in exercises, and raises the burial of those
  /// texels that stand out of the skin meanwhile. Without limbs the burial of all texels is that at rest.
  std::span<const body::Part> part = {};
};

/// The same proxy, bound: its hash is another one, each ellipsoid has its bone. Fails with kInvalidArgument
/// if the weights are not those of the skin or there is no joint. Deterministic, parallel. Takes some .3 s of
/// one core for a body of 89 ellipsoids with relief. A proxy without tables is carried by (1) alone.
engine::Result<proxy::BodyProxy> bind(const engine::Context& context, const proxy::BodyProxy& proxy,
                                      const SkinnedBody& body);

}  // namespace bodice::binding
