// The order in which garments lie over each other, and where they cross.
#pragma once

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

}  // namespace bodice::tryon
