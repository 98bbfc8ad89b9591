// The steps that known_thickness_m() and moving_thickness_m() share.
#pragma once

#include <span>
#include <vector>

#include <bodice/collision/collider.hpp>
#include <bodice/engine/context.hpp>
#include <bodice/geometry/mesh_distance.hpp>
#include <bodice/geometry/tri_mesh.hpp>

namespace bodice::inline v0_1::tryon {

/// For each vertex of a garment at rest that is near the skin, the closest point of the skin. Vertices far
/// off are left out.
std::vector<geometry::Vec3> skin_below(const engine::Context& context, const geometry::TriMesh& garment,
                                       const geometry::MeshDistance& skin);

/// Sets `uncovered_m` to the distance of each skin point outside of the collider, meters; zero for points
/// inside.
void find_uncovered(const engine::Context& context, const collision::Collider& collider,
                    std::span<const geometry::Vec3> skin, std::span<float> uncovered_m);

/// Half the thickness of cloth plus the 99th percentile of `uncovered_m`, meters: at least 1 mm and at most 8
/// mm. `uncovered_m` has a zero for each vertex that was left out.
double thickness_for(std::vector<float> uncovered_m);

}  // namespace bodice::tryon
