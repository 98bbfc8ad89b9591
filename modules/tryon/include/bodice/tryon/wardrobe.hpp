#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <bodice/cloth/fabric.hpp>
#include <bodice/collision/collider.hpp>
#include <bodice/engine/result.hpp>
#include <bodice/geometry/mesh_distance.hpp>
#include <bodice/geometry/tri_mesh.hpp>
#include <bodice/tryon/tack.hpp>

namespace bodice::inline v0_1::io {
struct Look;
}

namespace bodice::inline v0_1::tryon {

/// A garment to wear.
struct WornGarment {
  std::string name;
  geometry::TriMesh mesh;             ///< meters, y up
  std::vector<geometry::Index> held;  ///< vertices that stay with the body
  /// Its look from io::import_garment(), for GLB; null: none.
  std::shared_ptr<const io::Look> look = nullptr;
};

/// All garments as one mesh for one solver, with the first vertex of each.
struct Wardrobe {
  geometry::TriMesh mesh;
  std::vector<geometry::Index> held;
  std::vector<std::size_t> first_vertex;  ///< #garments + 1
  std::vector<cloth::Tack> tacks;         ///< the tacks from add_tacks()
};

/// Joins the garments, in order. Fails with kInvalidArgument, naming garment and element, when a triangle or
/// a held vertex refers to a vertex that the garment does not have. O(#vertices).
engine::Result<Wardrobe> join(const std::vector<WornGarment>& garments);

/// Tacks the pieces of each garment that lie within `within_m` of each other (find_tacks()); returns the
/// tacked pieces of each garment.
std::vector<std::vector<TackedPiece>> add_tacks(const engine::Context& context,
                                                const std::vector<WornGarment>& garments, double within_m,
                                                Wardrobe& wardrobe);

/// The given fabric, or else cotton.
engine::Result<cloth::Fabric> fabric_or_cotton(const std::optional<cloth::Fabric>& fabric);

/// The distance that cloth should keep from a proxy: half the thickness of a cloth, plus the error of the
/// proxy below the garment. This error is the 99th percentile of how far skin below the garment's vertices
/// lies outside of the proxy, both at rest. The result is at least 1 mm and at most 8 mm. The size of the
/// triangles does not matter, because contact covers them (cloth::SolverOptions::face_contact). Cost: a
/// closest point of the skin and a query a vertex, some microseconds.
double known_thickness_m(const engine::Context& context, const geometry::TriMesh& garment,
                         const geometry::MeshDistance& skin, const collision::Collider& collider);

/// The positions of the held vertices (#held, world meters). Vertices inside the collider are pushed out to
/// its surface.
std::vector<geometry::Vec3> held_positions(const Wardrobe& wardrobe, const collision::Collider& collider,
                                           double thickness_m);

}  // namespace bodice::tryon
