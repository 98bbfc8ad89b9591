#include <bodice/geometry/fins.hpp>

#include <algorithm>

#include <bodice/geometry/disjoint_sets.hpp>

namespace bodice::inline v0_1::geometry {
namespace {

// A fin's largest share of the area. A hand, the smallest part that a wall could separate from a body, has 2
// % of the skin and dozens of triangles.
constexpr double kLargestFin = 0.01;
constexpr int kFewTriangles = 8;

struct Piece {
  double area = 0.0;
  int triangles = 0;
  bool open = false, hangs = false;
};

}  // namespace

std::vector<bool> find_fins(const TriMesh& mesh, const MeshEdges& edges) {
  const auto count = static_cast<Index>(mesh.triangles.size());
  if (edges.non_manifold == 0) return std::vector<bool>(count);  // fins hang on an edge of three triangles
  DisjointSets sets(count);
  for (Index e = 0; e < edges.ends.size(); ++e)
    if (edges.joins_two(e)) sets.unite(edges.triangles[e][0], edges.triangles[e][1]);

  std::vector<Piece> pieces(count);
  double area = 0.0;
  for (Index t = 0; t < count; ++t) {
    Piece& piece = pieces[sets.find(t)];
    const double of_triangle = 0.5 * area_vector(mesh, t).norm();
    piece.area += of_triangle;
    area += of_triangle;
    ++piece.triangles;
    for (const Index e : edges.of_triangle[t]) {
      if (edges.is_loop(e)) continue;
      piece.open |= edges.triangle_count[e] == 1;
      piece.hangs |= edges.triangle_count[e] > 2;
    }
  }
  const auto largest = std::max_element(pieces.begin(), pieces.end(),
                                        [](const Piece& a, const Piece& b) { return a.area < b.area; });
  std::vector<bool> fin(count);
  for (Index t = 0; t < count; ++t) {
    const Piece& piece = pieces[sets.find(t)];
    fin[t] = &piece != &*largest && piece.open && piece.hangs &&
             (piece.triangles <= kFewTriangles || piece.area < kLargestFin * area);
  }
  return fin;
}

}  // namespace bodice::geometry
