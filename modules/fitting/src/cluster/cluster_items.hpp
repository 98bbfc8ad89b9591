// What each tier clusters, and the regions it is clustered in.
#pragma once

#include <bodice/fitting/fit.hpp>

#include "cluster/refinement.hpp"

namespace bodice::fitting {

/// The paper's choice: vertices only.
Items vertex_items(const LabeledSkin& skin);

/// The solid tier's: every triangle whole, where it belongs by most of its corners.
Items triangle_items(const engine::Context& context, const LabeledSkin& skin);

/// One region a limb part (k = 1) and one for the torso, seeded by the means of its six parts. If that would
/// be more than `most`, limbs join their neighbors, outer ones first.
std::vector<Region> make_regions(const Items& items, int most);

}  // namespace bodice::fitting
