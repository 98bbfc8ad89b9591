// The distance that cloth keeps from a body that moves.
#pragma once

#include <bodice/engine/context.hpp>
#include <bodice/engine/result.hpp>
#include <bodice/geometry/tri_mesh.hpp>
#include <bodice/proxy/base_pose.hpp>
#include <bodice/tryon/motion.hpp>
#include <bodice/tryon/prepare.hpp>

namespace bodice::inline v0_1::tryon {

/// The thickness of known_thickness_m() over poses that are spread evenly over the clip. In each pose it
/// measures how far the skin below the garment lies outside of the proxy, which is posed with these base
/// poses. Skin inside another part of the body does not lie outside. Fails where a pose is refused. Cost: a
/// closest point of the skin a vertex, and in each pose a query a vertex.
engine::Result<double> moving_thickness_m(const engine::Context& context, const geometry::TriMesh& garment,
                                          const PreparedBody& body, const BodyMotion& motion,
                                          const proxy::BasePoses& bases);

}  // namespace bodice::tryon
