// A body's vertices by region, in the form of GarmentCode's segmentations.
#pragma once

#include <span>
#include <string>

#include <bodice/tryon/prepare.hpp>

namespace bodice::inline v0_1::tryon {

/// A JSON object with the indices of vertices: `body` (head and trunk), `left_arm`, `right_arm`, `left_leg`,
/// `right_leg`, and `face_internal` for those inside the skin, such as eyes and teeth. Each vertex is in one
/// list; left and right are the body's own. `vertices` are those of the body's file, in its unit and axes:
/// the part is that of the closest point of the skin. Cost: an exact distance a vertex.
std::string segmentation_json(const engine::Context& context, const SegmentedSkin& skin,
                              std::span<const geometry::Vec3> vertices);

}  // namespace bodice::tryon
