#pragma once

#include <cstdint>
#include <vector>

#include <bodice/geometry/tri_mesh.hpp>

namespace bodice::inline v0_1::geometry {

/// A sample point of a surface, with the triangle that holds it.
struct SurfaceSample {
  Vec3 point = Vec3::Zero();
  Index triangle = kNoIndex;
  double area = 0.0;  ///< square meters, equal for all; their sum is the surface's area
};

/// Spreads `count` points evenly over the surface: stratified by the triangles' cumulative area, and by a
/// low-discrepancy sequence within them. The result is a function of the arguments alone, and empty for a
/// mesh without area. Cost: O(#F + count).
/// Source of the sequence (R2): Martin Roberts. The Unreasonable Effectiveness of Quasirandom Sequences.
/// 2018.
std::vector<SurfaceSample> sample_surface(const TriMesh& mesh, std::size_t count, std::uint64_t seed);

}  // namespace bodice::geometry
