// The room between surfaces of the skin that face each other. Where it is less than two layers of cloth need,
// cloth cannot be outside of the skin without crossings. Crossings are classified by this.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <bodice/engine/context.hpp>
#include <bodice/geometry/mesh_distance.hpp>
#include <bodice/geometry/tri_mesh.hpp>

namespace bodice::inline v0_1::tryon {

/// Widths of the gaps of one skin. It refers to the mesh and its distance, which must outlive it.
class SkinRoom {
 public:
  /// `distance` is that of `skin`.
  SkinRoom(const geometry::TriMesh& skin, const geometry::MeshDistance& distance)
      : skin_(&skin), distance_(&distance) {}

  /// The room at a point, meters, at most `most_m`. It is the distance from the closest point of the skin to
  /// the nearest skin in front of it with a normal more than 120 degrees from the one there:
  /// between parallel walls their distance, in a wedge of less than 60 degrees that to its other wall. Zero
  /// where the point or that closest point lies in skin that overlaps itself. Cost: a pass over the skin.
  double width_m(const geometry::Vec3& at, double most_m) const;

 private:
  const geometry::TriMesh* skin_;
  const geometry::MeshDistance* distance_;
};

/// Two triangles of cloth that cross.
struct JudgedCrossing {
  std::array<std::size_t, 2> triangles = {};
  geometry::Vec3 at = geometry::Vec3::Zero();  ///< the mean of the points where edges pass through triangles
  bool has_room = false;                       ///< whether the skin leaves `needed_m` there
};

/// All crossings of the cloth, in the order of geometry::find_crossings(). `needed_m` is what two layers
/// take: their distances from the skin and their gap. The same for any number of workers.
std::vector<JudgedCrossing> judge_crossings(const engine::Context& context, const SkinRoom& room,
                                            std::span<const geometry::Vec3> positions,
                                            std::span<const geometry::Triangle> triangles, double needed_m);

}  // namespace bodice::tryon
