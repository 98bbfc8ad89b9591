// Where a garment belongs that is in another unit than its body, has another axis up, or lies beside it.
#pragma once

#include <optional>
#include <string>

#include <bodice/engine/context.hpp>
#include <bodice/engine/result.hpp>
#include <bodice/geometry/mesh_distance.hpp>
#include <bodice/geometry/tri_mesh.hpp>

namespace bodice::inline v0_1::tryon {

/// What a garment is put on.
struct PlacedOn {
  const geometry::MeshDistance& skin;
  const geometry::TriMesh& mesh;  ///< the skin's, meters, y up
  double stature_m = 0.0;
  /// The garment was read in a unit of so many meters, which need not be that of its file.
  double meters_per_unit = 1.0;
};

/// Finds unit, axes and position of a garment by where the body is, and changes the mesh. A garment that lies
/// on the body, or near it at its size, is left as it is. Else units (meters to millimeters, inches, feet)
/// and upright axes are tried, and shifts of some decimeters: the one that lies on the body is
/// taken where no other one does about as well, and the warning `garment-placed` states it. Fails with
/// kUnusableGeometry where none does; the message has the garment's size and distance. `name` is for
/// messages. Deterministic. Cost: some thousand closest points, milliseconds.
engine::Result<std::optional<engine::Warning>> place_garment(const engine::Context& context,
                                                             const PlacedOn& body, const std::string& name,
                                                             geometry::TriMesh& garment);

}  // namespace bodice::tryon
