#pragma once

#include <cstdint>
#include <vector>

#include <bodice/geometry/tri_mesh.hpp>

namespace bodice::geometry {

struct SurfaceSample {
  Vec3 point = Vec3::Zero();
  Index triangle = kNoIndex;
  double area = 0.0;  ///< square meters that it stands for: the same for all, the sum is the surface's area
};

/// `count` points spread evenly over the surface: stratified along the triangles' running area, by a
/// low-discrepancy sequence within them. A pure function of its arguments; empty without area. Cost:
/// O(#F + count).
/// Source of the sequence: Martin Roberts. The Unreasonable Effectiveness of Quasirandom Sequences. 2018.
/// (R2)
std::vector<SurfaceSample> sample_surface(const TriMesh& mesh, std::size_t count, std::uint64_t seed);

}  // namespace bodice::geometry
