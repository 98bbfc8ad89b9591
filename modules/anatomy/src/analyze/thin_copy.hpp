// Limbs that a scan has welded come apart inside: a thinner copy of the body is analyzed in place of the
// skin.
#pragma once

#include <optional>
#include <span>
#include <utility>

#include <bodice/anatomy/anatomy.hpp>
#include <bodice/geometry/contour.hpp>
#include <bodice/geometry/mesh_distance.hpp>

#include "analyze/webs.hpp"

namespace bodice::inline v0_1::anatomy {

/// Where the skin lies this deep below a skin. Welds thinner than twice the depth are gone; so are fingers.
struct ThinCopy {
  geometry::TriMesh mesh;
  double depth = 0.0;  ///< in the unit of the skin
  double cell = 0.0;   ///< edge of the cells that it was contoured on
};

/// A skin on a grid, of which thin copies are made.
class SampledSkin {
 public:
  /// Nothing where the body would need too large a grid. `distance` is that of the skin, and outlives this.
  static std::optional<SampledSkin> make(const geometry::TriMesh& skin,
                                         const geometry::MeshDistance& distance);

  /// The copy that lies so deep, a share of the body's height. Webs are cut out of it. Empty where nothing
  /// lies so deep. Cost: half a second, for another copy of the same skin half of it.
  std::optional<ThinCopy> thin_copy(const engine::Context& context, double depth_share,
                                    std::span<const Web> webs);

 private:
  SampledSkin(double height, double cell, geometry::NodeDistances distances)
      : height_(height), cell_(cell), distances_(std::move(distances)) {}

  double height_, cell_;
  geometry::NodeDistances distances_;
};

/// What was found on a thin copy, on its skin: parts spread along the skin from where it lies right above the
/// copy, tips move to the ends of their limbs, and what lies on the skin moves out to it.
Anatomy carry_out(const engine::Context& context, const ThinCopy& thin, const Anatomy& found,
                  const geometry::TriMesh& skin);

}  // namespace bodice::anatomy
