#pragma once

#include <vector>

#include <bodice/fitting/fit.hpp>

namespace bodice::fitting {

/// Triangles cut into pieces, each to be held by an ellipsoid of its own.
struct CoverPieces {
  geometry::TriMesh mesh;  ///< the skin's vertices, then middles of edges
};

/// Cuts in four, a few times over, every one of the triangles that lies across a crease between ellipsoids,
/// so that neither has to grow over the other's part of it: that is a sixth of a cover's gap. All of
/// the mesh's triangles are to be covered. O(#triangles #ellipsoids).
CoverPieces cut_at_creases(const LabeledSkin& skin, std::span<const geometry::Index> triangles,
                           std::span<const geometry::Ellipsoid> ellipsoids);

}  // namespace bodice::fitting
