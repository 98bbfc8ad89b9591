// Limbs that a scan has welded come apart inside: a thinner copy of the body is analyzed in place of the
// skin.
#pragma once

#include <optional>
#include <span>

#include <bodice/anatomy/anatomy.hpp>
#include <bodice/geometry/mesh_distance.hpp>

#include "analyze/webs.hpp"

namespace bodice::anatomy {

/// Where the skin lies this deep below a skin. Welds thinner than twice the depth are gone; so are fingers.
struct ThinCopy {
  geometry::TriMesh mesh;
  double depth = 0.0;  ///< in the unit of the skin
  double cell = 0.0;   ///< edge of the cells that it was contoured on
};

/// The copy of a skin that lies so deep, a share of the body's height; `distance` is that of the skin. Webs
/// are cut out of it. Empty where nothing lies so deep, or the body would need too large a grid. Cost: half a
/// second.
std::optional<ThinCopy> thin_copy(const engine::Context& context, const geometry::TriMesh& skin,
                                  const geometry::MeshDistance& distance, double depth_share,
                                  std::span<const Web> webs);

/// What was found on a thin copy, on its skin: parts spread along the skin from where it lies right above the
/// copy, tips move to the ends of their limbs, and what lies on the skin moves out to it.
Anatomy carry_out(const engine::Context& context, const ThinCopy& thin, const Anatomy& found,
                  const geometry::TriMesh& skin);

}  // namespace bodice::anatomy
