// Where the skin points of a table's texels are in a pose, against where the carried ellipsoid expects them.
#pragma once

#include <span>

#include <bodice/geometry/detail/float4.hpp>

#include "pose/carried_ellipsoid.hpp"

namespace bodice::inline v0_1::binding {

/// One texel's change: the closest point of its skin point moved by (x, y, z) on the unit sphere of the rest
/// table, and its height over the ellipsoid grew by w meters.
using Change = geometry::Float4;

/// The maps of an ellipsoid's terms from its bundles' units to its posed frame, in units of its longest
/// radius: 12 floats each, by rows.
void posed_maps(const geometry::Vec3& rest_center, double step_m, std::span<const proxy::CarryTerm> terms,
                std::span<const proxy::JointMatrix> skinning, const CarriedEllipsoid& carried,
                std::span<float> maps);

/// Writes changes[texel] of each skin node of an ellipsoid. `maps` are those of posed_maps(). Allocates
/// nothing.
void find_changes(const proxy::Binding& binding, std::size_t ellipsoid, const CarriedEllipsoid& carried,
                  const float* maps, Change* changes);

}  // namespace bodice::binding
