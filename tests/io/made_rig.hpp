// A rig for the figure of known truth, with everything that files can express.
#pragma once

#include <bodice/rig/rig.hpp>

#include "figure.hpp"

namespace io_test {

/// Joints: a root and a chain up the figure, one of them scaled unevenly, one that skins nothing, and a
/// second root. Six joints a vertex at the most. Clips: step, linear and cubic keys; one key alone.
bodice::rig::Rig made_rig(const TriMesh& skin);

/// The skin posed by a clip at a time.
std::vector<Vec3> posed(const TriMesh& skin, const bodice::rig::Rig& rig, const bodice::rig::Clip& clip,
                        double time_s);

}  // namespace io_test
