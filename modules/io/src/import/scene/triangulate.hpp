#pragma once

#include <span>
#include <vector>

#include <bodice/geometry/tri_mesh.hpp>

namespace bodice::inline v0_1::io {

/// Splits a polygon, convex or not, into size - 2 triangles of the same winding by cutting ears, and appends
/// them. Fewer than three corners give none. Polygons that cross themselves or are not finite are fanned.
/// O(n^2).
void triangulate(std::span<const geometry::Vec3> positions, std::span<const geometry::Index> polygon,
                 std::vector<geometry::Triangle>& triangles);

}  // namespace bodice::io
