#pragma once

#include <vector>

#include <bodice/fitting/fit.hpp>

namespace bodice::inline v0_1::fitting {

/// Triangles cut into pieces; different ellipsoids may hold the pieces of one triangle.
struct CoverPieces {
  geometry::TriMesh mesh;  ///< the skin's vertices, then middles of edges
};

/// Cuts the triangles that lie across a crease between ellipsoids in four, up to three times, so that no
/// ellipsoid has to grow over another's part of a triangle. That takes a sixth off the gap of a cover. A
/// cover has to hold all triangles of the result. O(#triangles #ellipsoids).
CoverPieces cut_at_creases(const LabeledSkin& skin, std::span<const geometry::Index> triangles,
                           std::span<const geometry::Ellipsoid> ellipsoids);

}  // namespace bodice::fitting
