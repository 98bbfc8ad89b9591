// Nodes of ellipsoids that move: the unit sphere's translation, rotation and scale at each kept frame.
#pragma once

#include <span>
#include <vector>

#include <bodice/geometry/ellipsoid.hpp>

#include "skin_writer.hpp"

namespace bodice::inline v0_1::io {

/// The same ellipsoid with its axes reordered and reversed so that they are as near to `before` as they can
/// be: between keys a node then turns by the least angle.
geometry::Ellipsoid aligned(const geometry::Ellipsoid& shape, const geometry::Mat3& before);

/// Adds channels of a node that follow its ellipsoid; `shapes` are in the file's units and axes, one for each
/// time of the accessor `times`.
void add_ellipsoid_keys(std::span<const geometry::Ellipsoid> shapes, std::size_t node, std::size_t times,
                        GlbBuilder& glb, GlbAnimation& animation);

}  // namespace bodice::io
