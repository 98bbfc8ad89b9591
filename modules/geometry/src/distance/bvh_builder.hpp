// Divides triangles into the nodes of a tree.
// Based on: Ingo Wald. On fast Construction of SAH-based Bounding Volume Hierarchies. 2007. (binned splits)
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "distance/bvh.hpp"

namespace bodice::inline v0_1::geometry {

/// A box in the local frame.
struct FloatBox {
  std::array<float, 3> low, high;
  FloatBox() {
    low.fill(std::numeric_limits<float>::infinity());
    high.fill(-std::numeric_limits<float>::infinity());
  }
  void extend(const FloatBox& other) {
    for (int k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], other.low[k]);
      high[k] = std::max(high[k], other.high[k]);
    }
  }
  float half_area() const {
    const float x = high[0] - low[0], y = high[1] - low[1], z = high[2] - low[2];
    return x >= 0.0f ? x * y + y * z + z * x : 0.0f;
  }
};

/// The box of a triangle, rounded outward.
FloatBox float_box(const BvhTriangle& triangle);

/// The nodes and leaves of a tree, and the triangles in the order of its leaves.
struct BvhNodes {
  std::vector<BvhNode> nodes;
  std::vector<LeafTriangles> leaves;  ///< their ranges; lanes are not set
  std::vector<std::uint32_t> order;   ///< indices of triangles
};

/// Divides at least one triangle. O(n log n), with the same bits for any number of workers.
BvhNodes divide_triangles(const engine::Context& context, const std::vector<BvhTriangle>& triangles);

}  // namespace bodice::geometry
