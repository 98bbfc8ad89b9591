// Triangles of cloth that cross.
#pragma once

#include <string>
#include <vector>

#include <bodice/engine/result.hpp>
#include <bodice/geometry/mesh_distance.hpp>
#include <bodice/tryon/wardrobe.hpp>

namespace bodice::inline v0_1::tryon {

/// A skin with the parts of its vertices.
struct LabeledSkinView {
  const geometry::TriMesh& mesh;
  const std::vector<body::Part>& part;
  const geometry::MeshDistance& distance;
};

/// The number of pairs of triangles that cross, of all garments at `positions`. A warning `layers-cross`
/// states the number, and the garments and the part of the body of the first pair. Cost: that of
/// geometry::find_crossings().
std::size_t measure_crossings(const Wardrobe& all, const std::vector<WornGarment>& garments,
                              std::span<const geometry::Vec3> positions, const LabeledSkinView& skin,
                              std::vector<engine::Warning>& warnings);

}  // namespace bodice::tryon
