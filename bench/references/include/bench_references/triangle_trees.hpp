// The method that the paper compares itself with: two trees of boxes over the triangles of garment and body,
// refitted every frame and descended together.
#pragma once

#include <cstdint>
#include <vector>

#include <bodice/geometry/tri_mesh.hpp>

namespace bench {

/// A tree of boxes over the triangles of one mesh.
class TriangleTree {
 public:
  /// Splits at the median of the longest axis; the mesh must outlive the tree.
  explicit TriangleTree(const bodice::geometry::TriMesh& mesh);
  /// Updates the boxes to the current vertices.
  void refit();

  /// Number of garment vertices within `thickness_m` of a triangle of `body`; each pair of triangles counts.
  std::size_t count_contacts(const TriangleTree& body, double thickness_m) const;

 private:
  struct Node {
    float low[3], high[3];
    std::uint32_t first = 0, count = 0;  ///< triangles of a leaf; count 0: children first and first + 1
  };
  void split(std::uint32_t node, std::uint32_t begin, std::uint32_t end);
  void enclose(Node& node) const;
  std::size_t count_leaves(const Node& mine, const TriangleTree& body, const Node& other,
                           double thickness_m) const;
  static bool apart(const Node& a, const Node& b, float thickness_m);

  const bodice::geometry::TriMesh& mesh_;
  std::vector<bodice::geometry::Vec3> middle_;  // used only while the tree is built
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace bench
