// Meshes of any resolution from one cage: each quad becomes a grid, and opposite edges have the same count.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "mesh/cage.hpp"

#include <bodice/geometry/types.hpp>

namespace bodice::inline v0_1::synth {

/// A point of the cage: a quad, with u from its corner 0 to 1 and v from 0 to 3.
struct PatchPoint {
  int quad = 0;
  double u = 0.0, v = 0.0;
};

struct PatchMesh {
  std::vector<PatchPoint> at;                         ///< #V
  std::vector<Region> region;                         ///< #V
  std::vector<std::array<geometry::Index, 4>> quads;  ///< of vertices
  std::vector<int> cage_quad;                         ///< #quads
  std::vector<std::array<int, 2>> counts;             ///< #cage quads: cells along u and v
  std::vector<std::vector<geometry::Index>> grid;     ///< #cage quads: (nv + 1) x (nu + 1) vertices
};

/// The edges of a cage, sorted into classes that are cut into equally many pieces.
class Patches {
 public:
  explicit Patches(const Cage& cage);

  int class_count() const { return class_count_; }
  /// The mean length of the edges of each class, for the given positions.
  std::vector<double> class_lengths(const std::vector<Vec3>& cage_positions) const;
  /// The number of vertices of the mesh with these counts (#classes), without building it.
  std::int64_t vertex_count(const std::vector<int>& counts) const;
  PatchMesh tessellate(const std::vector<int>& counts) const;

 private:
  struct Edge {
    int a, b;  ///< a < b
    int edge_class;
    Region region;
  };
  void find_edges();
  void find_classes();
  std::vector<geometry::Index> edge_vertices(PatchMesh& mesh, int quad, int k, const std::vector<int>& counts,
                                             std::vector<std::vector<geometry::Index>>& of_edge) const;

  const Cage& cage_;
  std::vector<Edge> edges_;
  std::vector<std::array<int, 4>> edge_of_quad_;  ///< edge k runs from corner k to corner k + 1
  int class_count_ = 0;
};

/// The counts for an edge length, at least one.
std::vector<int> counts_for(const std::vector<double>& class_lengths, double edge_length);

/// The counts with a vertex number closest to the wanted one.
std::vector<int> counts_for_vertices(const Patches& patches, const std::vector<double>& class_lengths,
                                     std::int64_t vertices);

/// Interpolates values at the vertices of `mesh` to any patch point, bilinearly in its grid.
template <class T>
T sample(const PatchMesh& mesh, const std::vector<T>& values, const PatchPoint& at) {
  const int nu = mesh.counts[at.quad][0], nv = mesh.counts[at.quad][1];
  const double x = at.u * nu, y = at.v * nv;
  const int c = std::min(static_cast<int>(x), nu - 1), r = std::min(static_cast<int>(y), nv - 1);
  const double s = x - c, t = y - r;
  const auto& grid = mesh.grid[at.quad];
  const auto value = [&](int dc, int dr) -> const T& { return values[grid[(r + dr) * (nu + 1) + c + dc]]; };
  using Scalar = typename T::Scalar;
  const auto weight = [](double x_share, double y_share) { return static_cast<Scalar>(x_share * y_share); };
  return T(weight(1.0 - s, 1.0 - t) * value(0, 0) + weight(s, 1.0 - t) * value(1, 0) +
           weight(1.0 - s, t) * value(0, 1) + weight(s, t) * value(1, 1));
}

}  // namespace bodice::synth
