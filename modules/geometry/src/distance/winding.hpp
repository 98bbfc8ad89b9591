// Generalized winding numbers over a Bvh.
#pragma once

#include <optional>

#include "distance/bvh.hpp"

namespace bodice::inline v0_1::geometry {

/// The far fields of a node's children, side by side like their boxes.
struct DipoleNode {
  Float4 center[3];  ///< area-weighted centroid
  Float4 area[3];    ///< sum of area vectors
  Float4 radius2;    ///< squared radius of the triangles around the centroid
};

/// The dipoles of all nodes, in the order of bvh.nodes. O(n).
std::vector<DipoleNode> build_dipoles(const Bvh& bvh);

/// The winding number at a query in the local frame. A dipole replaces a child when the query is farther away
/// than `far_ratio` times its radius; with infinity the sum is exact.
double winding_number(const Bvh& bvh, const std::vector<DipoleNode>& dipoles, const Vec3& local_query,
                      double far_ratio);

/// The same in floats, four triangles at a time, for about half of the cost; within 2e-3 but beside slivers.
/// Nothing where the query lies so near to a triangle that its side is not known in floats.
std::optional<double> float_winding_number(const Bvh& bvh, const std::vector<DipoleNode>& dipoles,
                                           const Vec3& local_query, double far_ratio);

}  // namespace bodice::geometry
