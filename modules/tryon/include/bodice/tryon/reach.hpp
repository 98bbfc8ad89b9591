// The part of a body or proxy that a garment can reach. The rest need not be fitted, stored or tested.
#pragma once

#include <span>

#include <bodice/engine/context.hpp>
#include <bodice/engine/result.hpp>
#include <bodice/geometry/tri_mesh.hpp>
#include <bodice/proxy/body_proxy.hpp>
#include <bodice/tryon/prepare.hpp>

namespace bodice::inline v0_1::tryon {

/// The parts of the skin within `margin_m` of any garment, as a bit set for FitOptions::parts; 0 if there is
/// none. A part that is farther away, by at most the size of a triangle, may be included. Fails with
/// kInvalidArgument when the margin is negative or not finite or a triangle refers to a missing vertex, and
/// with kCanceled. The result does not depend on the number of workers. Cost: O(#triangles of the skin log
/// #triangles of a garment).
engine::Result<std::uint32_t> reachable_parts(const engine::Context& context, const SegmentedSkin& skin,
                                              std::span<const geometry::TriMesh> garments, double margin_m);

/// A proxy of the ellipsoids, with their tables, within `margin_m` of any garment, in their order. At a point
/// within a of a garment, proxy_distance() has the same bits as for the whole proxy if the distance to the
/// whole proxy's closest ellipsoid is at most margin_m - a. A garment that moves farther than the margin may
/// pass through the missing part. Fails with kUnusableGeometry when nothing is within reach, and as
/// reachable_parts(). Cost: O(#triangles #ellipsoids), a sphere test for most.
engine::Result<proxy::BodyProxy> within_reach(const engine::Context& context, const proxy::BodyProxy& proxy,
                                              std::span<const geometry::TriMesh> garments, double margin_m);

}  // namespace bodice::tryon
