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
/// the shirt in. A file's name does without folder and ending. Garments that are not named stay as they are.
/// What lies up to 4 cm below an inner garment is moved to `gap_m` above it; garments that are farther
/// through each other still cross afterwards. Fails with kInvalidArgument where a name is that of no garment
/// or stands twice. Cost: some closest points a vertex, up to 40 times.
engine::Result<std::vector<WornGarment>> order_layers(const engine::Context& context,
                                                      const geometry::MeshDistance& skin,
                                                      const std::vector<std::string>& order,
                                                      std::vector<WornGarment> garments, double gap_m);

}  // namespace bodice::tryon
