// Puts a garment on its body that is in another unit, has another axis up, or lies beside the body.
#pragma once

#include <optional>
#include <string>

#include <bodice/engine/context.hpp>
#include <bodice/engine/result.hpp>
#include <bodice/geometry/mesh_distance.hpp>
#include <bodice/geometry/tri_mesh.hpp>

namespace bodice::inline v0_1::tryon {

/// The body that a garment is put on.
struct PlacedOn {
  const geometry::MeshDistance& skin;
  const geometry::TriMesh& mesh;  ///< the skin's, meters, y up
  double stature_m = 0.0;
  /// The unit in which the garment was read, meters. It need not be that of its file.
  double meters_per_unit = 1.0;
};

/// Finds unit, axes and position of a garment from the position of the body, and changes the mesh. A garment
/// on the body, or of a plausible size near it, stays as it is. Otherwise units (meters to millimeters,
/// inches, feet), upright axes and shifts of some decimeters are tried. One that puts the garment on the body
/// is used if no other one does so about as well; the warning `garment-placed` states it. Fails with
/// kUnusableGeometry where there is none; the message states the garment's size and distance. `name` appears
/// in messages. Deterministic. Cost: some thousand closest points, milliseconds.
engine::Result<std::optional<engine::Warning>> place_garment(const engine::Context& context,
                                                             const PlacedOn& body, const std::string& name,
                                                             geometry::TriMesh& garment);

}  // namespace bodice::tryon
