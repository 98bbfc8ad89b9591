#pragma once

#include <optional>
#include <string>
#include <vector>

#include <bodice/cloth/fabric.hpp>
#include <bodice/collision/collider.hpp>
#include <bodice/engine/result.hpp>
#include <bodice/geometry/mesh_distance.hpp>
#include <bodice/geometry/tri_mesh.hpp>

namespace bodice::tryon {

/// A garment to wear.
struct WornGarment {
  std::string name;
  geometry::TriMesh mesh;             ///< meters, y up
  std::vector<geometry::Index> held;  ///< vertices that stay with the body
};

/// All garments as one mesh for one solver, with the first vertex of each.
struct Wardrobe {
  geometry::TriMesh mesh;
  std::vector<geometry::Index> held;
  std::vector<std::size_t> first_vertex;  ///< #garments + 1
};

/// Joins the garments, in order. Fails with kInvalidArgument, naming garment and element, when a triangle or
/// a held vertex refers to a vertex that the garment does not have. O(#vertices).
engine::Result<Wardrobe> join(const std::vector<WornGarment>& garments);

/// The given fabric, or else cotton.
engine::Result<cloth::Fabric> fabric_or_cotton(const std::optional<cloth::Fabric>& fabric);

/// A thickness that keeps triangles, and not only their corners, out of the skin. It is 1.5 mm plus the
/// height of the arc over a long edge (90 % are shorter) on a limb, at most 8 mm. O(#edges).
double covering_thickness_m(const geometry::TriMesh& garment, double stature_m);

/// The covering thickness, but at most the distance that half of the garment's vertices have from the skin
/// (and at least 1.5 mm): a tight garment that is pushed farther off is stretched all around. Vertices inside
/// the skin count as touching it. Cost: one signed distance a vertex.
double fitted_thickness_m(const engine::Context& context, const geometry::TriMesh& garment,
                          const geometry::MeshDistance& skin, double stature_m);

/// The positions of the held vertices (#held, world meters). Those inside the collider are pushed out of it,
/// as a waistband lies on the body.
std::vector<geometry::Vec3> held_positions(const Wardrobe& wardrobe, const collision::Collider& collider,
                                           double thickness_m);

}  // namespace bodice::tryon
