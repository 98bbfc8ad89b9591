// The distance that cloth keeps from a body that moves.
#pragma once

#include <bodice/engine/context.hpp>
#include <bodice/engine/result.hpp>
#include <bodice/geometry/tri_mesh.hpp>
#include <bodice/proxy/base_pose.hpp>
#include <bodice/tryon/motion.hpp>
#include <bodice/tryon/prepare.hpp>

namespace bodice::inline v0_1::tryon {

/// The thickness as by known_thickness_m(), for the skin below the garment in poses that are spread over the
/// clip, where it stands out of the proxy that is posed with these base poses. Skin that another part of the
/// body covers does not stand out. Fails where a pose is refused. Cost: a closest point of the skin a vertex,
/// and in each pose a query a vertex.
engine::Result<double> moving_thickness_m(const engine::Context& context, const geometry::TriMesh& garment,
                                          const PreparedBody& body, const BodyMotion& motion,
                                          const proxy::BasePoses& bases);

}  // namespace bodice::tryon
