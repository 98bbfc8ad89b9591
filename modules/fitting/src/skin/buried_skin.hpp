// Skin that lies inside another limb of a posed body. It is no boundary of the body, and a distance to it is
// no depth.
#pragma once

#include <cstdint>
#include <vector>

#include <bodice/engine/context.hpp>
#include <bodice/geometry/mesh_distance.hpp>
#include <bodice/geometry/tri_mesh.hpp>

namespace bodice::inline v0_1::fitting {

/// Fraction of stature, about 0.3 mm: a point this far off the skin is beyond rounding, and within any fold
/// that matters.
inline constexpr double kStepOffSkin = 2e-4;

/// One flag a triangle: whether a corner lies inside another limb. Winding numbers are evaluated at every
/// eighth vertex, spread along the skin, and evaluated again where neighbors differ and where a normal points
/// at the back of other skin.
std::vector<std::uint8_t> buried_triangles(const engine::Context& context, const geometry::TriMesh& mesh,
                                           const geometry::MeshDistance& distance, double stature_m);

}  // namespace bodice::fitting
