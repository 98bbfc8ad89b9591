// A thinned surface without the noise of the one that it comes from.
#pragma once

#include <vector>

#include <bodice/geometry/thin.hpp>

namespace bodice::inline v0_1::geometry {

/// Where the vertices of a thinned surface lie without noise of a standard deviation. Each stands for the
/// vertices that were merged into it: a quadric goes through the means of such groups, as many rings of them
/// as agree within the noise.
std::vector<Vec3> smooth_groups(const engine::Context& context, const TriMesh& noisy,
                                const ThinnedSurface& thinned, double noise);

}  // namespace bodice::geometry
