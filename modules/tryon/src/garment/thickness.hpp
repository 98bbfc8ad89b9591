// The steps by which the distance that cloth keeps is found: known_thickness_m() for bodies at rest and in
// motion.
#pragma once

#include <span>
#include <vector>

#include <bodice/collision/collider.hpp>
#include <bodice/engine/context.hpp>
#include <bodice/geometry/mesh_distance.hpp>
#include <bodice/geometry/tri_mesh.hpp>

namespace bodice::inline v0_1::tryon {

/// The closest points of the skin to the vertices of a garment at rest that may come to lie on it; vertices
/// far off are left out.
std::vector<geometry::Vec3> skin_below(const engine::Context& context, const geometry::TriMesh& garment,
                                       const geometry::MeshDistance& skin);

/// Sets `missed_m` to how far each point of the skin stands out of the collider, meters; zero where it does
/// not.
void find_missed(const engine::Context& context, const collision::Collider& collider,
                 std::span<const geometry::Vec3> skin, std::span<float> missed_m);

/// Half the thickness of cloth plus the 99th percentile of `missed_m`, meters: at least 1 mm and at most 8
/// mm. `missed_m` has a zero for each vertex that was left out.
double thickness_for(std::vector<float> missed_m);

}  // namespace bodice::tryon
