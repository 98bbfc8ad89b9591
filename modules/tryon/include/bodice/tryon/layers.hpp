// Garments over each other, and layers that cross in their files.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <bodice/engine/context.hpp>
#include <bodice/engine/result.hpp>
#include <bodice/geometry/mesh_distance.hpp>
#include <bodice/tryon/wardrobe.hpp>

namespace bodice::inline v0_1::tryon {

/// Moves garments away from the skin until each lies over those named before it: "shirt", "trousers" tucks
/// the shirt in. The name of a file may lack folder and extension. Garments that are not named stay as they
/// are. A vertex up to 4 cm below an inner garment is moved to `gap_m` above it. Garments that pass deeper
/// through each other still cross afterwards. Fails with kInvalidArgument where a name matches no garment or
/// is repeated. Cost: some closest points a vertex, up to 40 times.
engine::Result<std::vector<WornGarment>> order_layers(const engine::Context& context,
                                                      const geometry::MeshDistance& skin,
                                                      const std::vector<std::string>& order,
                                                      std::vector<WornGarment> garments, double gap_m);

/// The pairs of triangles that crossed before layers were separated, and those that still do.
struct SeparatedLayers {
  std::size_t before = 0, after = 0;
};

/// Separates layers that cross in garments made for a body that stands at rest, such as a bodice and a skirt.
/// The layer that lies farther from the skin around their line is moved outward, until it is `gap_m` over the
/// other one. The same layer is moved at all lines of two pieces. Where a surface crosses itself in a crease
/// of the body, it is smoothed outside of the skin, so that it spans the crease. No vertex moves farther than
/// 15 mm, and vertices at equal positions move alike. Deterministic; never leaves more pairs than before.
/// drape() calls this, a session does not. Cost: up to 30 rounds, each of which finds all crossings and a few
/// closest points for each vertex near them.
SeparatedLayers separate_layers(const engine::Context& context, const geometry::MeshDistance& skin,
                                double gap_m, geometry::TriMesh& garments);

}  // namespace bodice::tryon
