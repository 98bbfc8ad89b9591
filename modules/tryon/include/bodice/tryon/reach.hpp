// What of a body or its proxy a garment can come near: the rest need be neither fitted, stored nor tested.
#pragma once

#include <span>

#include <bodice/engine/context.hpp>
#include <bodice/engine/result.hpp>
#include <bodice/geometry/tri_mesh.hpp>
#include <bodice/proxy/body_proxy.hpp>
#include <bodice/tryon/prepare.hpp>

namespace bodice::tryon {

/// The parts of the skin within `margin_m` of any of the garments, as FitOptions::parts takes them: what a
/// garment cannot reach need not be fitted. A part may be counted that is a triangle's size too far. Zero
/// when none is within reach. Fails with kInvalidArgument when the margin is negative or not finite or a
/// triangle names a vertex that is not there. Deterministic. Cost: O(#triangles of the skin log #triangles of
/// a garment).
engine::Result<std::uint32_t> reachable_parts(const engine::Context& context, const SegmentedSkin& skin,
                                              std::span<const geometry::TriMesh> garments, double margin_m);

/// The ellipsoids, with their tables, that are within `margin_m` of any of the garments; their order stays.
/// Where a place is within a of a garment and the whole proxy's nearest ellipsoid within margin_m - a of the
/// place, proxy_distance() gives the same bits as with the whole proxy. A garment that moves farther than the
/// margin may meet nothing. Fails with kUnusableGeometry when nothing is within reach, with kInvalidArgument
/// when the margin is negative or not finite or a triangle names a vertex that is not there. Deterministic.
/// Cost: O(#triangles #ellipsoids), a sphere test for most.
engine::Result<proxy::BodyProxy> within_reach(const engine::Context& context, const proxy::BodyProxy& proxy,
                                              std::span<const geometry::TriMesh> garments, double margin_m);

}  // namespace bodice::tryon
