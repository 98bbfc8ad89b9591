// The items that each tier clusters, and the regions that they are clustered in.
#pragma once

#include <bodice/fitting/fit.hpp>

#include "cluster/refinement.hpp"

namespace bodice::inline v0_1::fitting {

/// The items of tier paper: the vertices.
Items vertex_items(const LabeledSkin& skin);

/// The items of tier solid: whole triangles, each with the part of most of its corners.
Items triangle_items(const engine::Context& context, const LabeledSkin& skin);

/// One region for each part that is not torso, with one seed, and one region for the torso, seeded by the
/// means of its six parts. If these are more than `most` regions, limbs join their neighbors, the outer ones
/// first.
std::vector<Region> make_regions(const Items& items, int most);

}  // namespace bodice::fitting
