// Posed bodies interpenetrate: skin that lies inside another limb is no boundary of the body, and the
// distance to it is no depth.
#pragma once

#include <cstdint>
#include <vector>

#include <bodice/engine/context.hpp>
#include <bodice/geometry/mesh_distance.hpp>
#include <bodice/geometry/tri_mesh.hpp>

namespace bodice::fitting {

/// One flag a triangle. Winding numbers are asked at every eighth vertex, spread along the skin, and asked
/// again wherever neighbors disagree and where a vertex looks at the back of other skin.
std::vector<std::uint8_t> buried_triangles(const engine::Context& context, const geometry::TriMesh& mesh,
                                           const geometry::MeshDistance& distance, double stature_m);

}  // namespace bodice::fitting
