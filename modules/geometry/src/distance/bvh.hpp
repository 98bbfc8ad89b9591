// A four-wide bounding-volume tree over triangles, in a local unit-sized frame.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include <bodice/engine/context.hpp>
#include <bodice/geometry/tri_mesh.hpp>

#include "distance/leaf_triangles.hpp"

namespace bodice::inline v0_1::geometry {

/// A node with four children side by side, so that one pass of vector instructions tests all of them. Boxes
/// are floats in the local frame, rounded outward; a missing child has an empty box.
struct BvhNode {
  static constexpr int kWidth = 4;
  Float4 low[3];
  Float4 high[3];
  std::uint32_t child[kWidth];
};

/// Decodes BvhNode::child, which is either a node or a leaf.
struct BvhChild {
  static constexpr std::uint32_t kLeafBit = 1u << 31;
  static constexpr std::uint32_t kNone = ~0u;

  static std::uint32_t leaf(std::uint32_t index) { return kLeafBit | index; }
  static bool is_leaf(std::uint32_t child) { return (child & kLeafBit) != 0; }
  static std::uint32_t leaf_index(std::uint32_t child) { return child & ~kLeafBit; }
};

struct Bvh {
  static constexpr std::uint32_t kLeafSize = LeafTriangles::kWidth;
  /// A depth that no traversal exceeds: at most 20 levels by surface area, then halves of at most 2^28
  /// triangles, two halvings a level.
  static constexpr int kStackSize = 128;

  Vec3 origin = Vec3::Zero();
  double scale = 1.0;                   ///< meters a local unit: a power of two, so that scaling is exact
  std::vector<BvhNode> nodes;           ///< nodes[0] is the root; parents precede children
  std::vector<LeafTriangles> leaves;    ///< in the order of the nodes that hold them
  std::vector<BvhTriangle> triangles;   ///< in leaf order; only those with finite corners
  std::vector<Index> triangle_of_leaf;  ///< maps leaf order to the mesh's triangle

  Vec3 to_local(const Vec3& p) const { return (p - origin) / scale; }
  const LeafTriangles& leaf(std::uint32_t child) const { return leaves[BvhChild::leaf_index(child)]; }
};

/// Builds the tree in O(n log n), with the same bits for any number of workers. Precondition: at most 2^28
/// triangles.
Bvh build_bvh(const engine::Context& context, const TriMesh& mesh);

/// The tree `like`, fitted to other positions of the vertices of its mesh; O(n). Where these leave out other
/// triangles than it does, a tree is built.
Bvh refit_bvh(const engine::Context& context, const Bvh& like, const TriMesh& mesh);

}  // namespace bodice::geometry
