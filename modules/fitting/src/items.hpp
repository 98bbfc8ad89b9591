// What each tier clusters, and the regions it is clustered in.
#pragma once

#include <bodice/fitting/fit.hpp>

#include "refine.hpp"

namespace bodice::fitting {

/// The paper's choice: vertices only.
Items vertex_items(const LabelledSkin& skin, std::uint32_t parts);

/// The solid tier's: every triangle whole, and interior anchors (voxel centres `spacing_m` apart), so that
/// the clusters fill the body instead of lining it.
Items solid_items(const LabelledSkin& skin, std::uint32_t parts, std::span<const Vec3> anchors);

/// One region a limb part (k = 1) and one for the torso, seeded by the means of its six parts.
std::vector<Region> make_regions(const Items& items);

}  // namespace bodice::fitting
