// Thin copies of a skin. Limbs that a scan has welded are apart some millimeters below the skin, so that a
// thinner copy of the body is analyzed instead.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include <bodice/anatomy/anatomy.hpp>
#include <bodice/geometry/contour.hpp>
#include <bodice/geometry/mesh_distance.hpp>

#include "walls/webs.hpp"

namespace bodice::inline v0_1::anatomy {

/// The surface at a depth below a skin. Welds that are thinner than twice the depth are gone from it, and so
/// are fingers.
struct ThinCopy {
  geometry::TriMesh mesh;
  double depth = 0.0;  ///< in the unit of the skin
  double cell = 0.0;   ///< edge of the cells that it was contoured on
};

/// A skin on a grid, of which thin copies are made.
class SampledSkin {
 public:
  /// Samples a skin. Empty where the body would need too large a grid. `distance` is that of the skin, and
  /// must outlive the result.
  static std::optional<SampledSkin> make(const geometry::TriMesh& skin,
                                         const geometry::MeshDistance& distance);

  /// Returns the surface at a depth below the skin, which is `depth_share` of the body's height. Returns
  /// nothing if no point lies so deep. Cost: half a second, half of it for another copy of the same skin.
  std::optional<ThinCopy> thin_copy(const engine::Context& context, double depth_share);
  /// Cuts limbs apart, by the walls of limb_walls(), in all copies that are made later. Cost: half a second,
  /// less when called again.
  void wall_limbs(const engine::Context& context, const geometry::MeshDistance& distance, double neck);
  void remove_walls() { wall_.clear(); }
  /// Does the same by the walls of known_walls().
  void wall_known_limbs(const engine::Context& context, const geometry::MeshDistance& distance,
                        const Anatomy& found, const std::vector<Fold>& folds);

 private:
  SampledSkin(double height, double cell, geometry::NodeDistances distances)
      : height_(height), cell_(cell), distances_(std::move(distances)) {}

  void find_depths(const engine::Context& context, const geometry::MeshDistance& distance);

  double height_, cell_;
  geometry::NodeDistances distances_;
  geometry::FieldGrid depth_;  ///< below the skin, negative outside; empty until it is needed
  std::vector<char> wall_;     ///< #nodes, or empty
};

/// Transfers the result on a thin copy to its skin. Parts spread along the skin from vertices right above the
/// copy. Tips move to the ends of their limbs, and landmarks on the surface move out to the skin.
Anatomy carry_out(const engine::Context& context, const ThinCopy& thin, const Anatomy& found,
                  const geometry::TriMesh& skin);

}  // namespace bodice::anatomy
