// A mesh in which edges are merged one by one.
#pragma once

#include <array>
#include <vector>

#include <bodice/geometry/thin.hpp>

namespace bodice::inline v0_1::geometry {

/// Merging of vertices into neighbors. Calls that concern different blocks may run side by side.
class Merging {
 public:
  Merging(const TriMesh& mesh, const ThinOptions& options);

  /// Gives each vertex a block, by which merges keep to themselves.
  void set_blocks(std::vector<std::uint8_t> block_of) { block_ = std::move(block_of); }

  /// Merges the vertex into the nearest neighbor that suits, and returns whether there was one. Vertices with
  /// a neighbor in another block stay.
  bool merge(Index vertex);
  bool is_merged(Index vertex) const { return parent_[vertex] != vertex; }

  /// The mesh without what was merged.
  ThinnedSurface finish();

 private:
  static constexpr int kMostTriangles = 14;

  /// The closed fan of triangles around a vertex.
  struct Fan {
    std::array<Index, kMostTriangles> corner;  ///< the vertex' corner of each triangle
    std::array<Index, kMostTriangles> neighbor;
    std::array<int, kMostTriangles> uses;
    int triangles = 0, neighbors = 0;
    bool has(Index vertex) const;
  };

  template <class Visit>
  void for_each_corner(Index vertex, Visit&& visit);
  bool find_fan(Index vertex, Fan& fan);
  bool add_neighbor(Index vertex, Fan& fan) const;
  bool keeps_topology(Index vertex, Index into, const Fan& fan);
  bool keeps_shape(Index vertex, Index into, const Fan& fan, double& error) const;
  void apply(Index vertex, Index into, const Fan& fan);
  Index final_vertex(Index vertex);

  const std::vector<Vec3>& positions_;
  ThinOptions options_;
  std::vector<Triangle> triangles_;  // the first corner is kNoIndex where one is gone
  std::vector<Index> parent_;        // what each vertex was merged into; itself before that
  std::vector<Index> head_, next_;   // the corners at each vertex, as lists
  std::vector<double> error_;        // how far off the surface may be that a vertex stands for
  std::vector<std::uint8_t> block_;
};

}  // namespace bodice::geometry
