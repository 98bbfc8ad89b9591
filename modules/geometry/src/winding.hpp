// Generalised winding numbers over a Bvh.
#pragma once

#include "bvh.hpp"

namespace bodice::geometry {

/// Far fields of a Bvh's children, side by side as the boxes are.
struct DipoleNode {
  Float4 center[3];  ///< area-weighted centroid
  Float4 area[3];    ///< sum of area vectors
  Float4 radius2;    ///< squared reach of the triangles around the centroid
};

/// Parallel to bvh.nodes. O(n).
std::vector<DipoleNode> build_dipoles(const Bvh& bvh);

/// Winding number at a local-frame query. A child is replaced by its dipole when the query is more than
/// `far_ratio` of its radius away; infinite: exact.
double winding_number(const Bvh& bvh, const std::vector<DipoleNode>& dipoles, const Vec3& local_query,
                      double far_ratio);

}  // namespace bodice::geometry
