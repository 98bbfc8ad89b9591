#include <bodice/tryon/tack.hpp>

#include <algorithm>
#include <limits>
#include <map>

#include <bodice/engine/parallel.hpp>
#include <bodice/geometry/mesh_distance.hpp>
#include <bodice/geometry/mesh_edges.hpp>
#include <bodice/geometry/mesh_repair.hpp>

namespace bodice::inline v0_1::tryon {
namespace {

using geometry::Index;

// Shares of the largest piece's area: a button, a buckle or a pocket; a strap or a belt.
constexpr double kSmallPiece = 0.03, kStrap = 0.2;
// A rim of a larger piece is tacked where this share of it lies on another piece: it is a seam. Where less of
// it does, layers touch by chance, as a shirt's hem touches the trousers.
constexpr double kSeam = 0.3;
constexpr std::size_t kRimGrain = 64;

/// The welded garment, cut into its pieces.
struct Pieces {
  geometry::TriMesh mesh;
  geometry::Components components;
  std::vector<Index> input;                  // #V of the mesh: a vertex of the garment
  std::vector<std::vector<Index>> triangle;  // the triangles of each piece, by number
  std::vector<std::vector<Index>> rims;      // chains of vertices

  std::size_t count() const { return components.area.size(); }
  bool is_below(double share, std::size_t piece) const {
    return components.area[piece] < share * components.area.front();
  }
};

Pieces cut(const geometry::RepairedMesh& welded) {
  Pieces pieces{.mesh = welded.mesh, .components = geometry::connected_components(welded.mesh)};
  pieces.input.assign(pieces.mesh.positions.size(), geometry::kNoIndex);
  for (Index v = 0; v < welded.vertex_of_input.size(); ++v) {
    const Index w = welded.vertex_of_input[v];
    if (w != geometry::kNoIndex && pieces.input[w] == geometry::kNoIndex) pieces.input[w] = v;
  }
  pieces.triangle.resize(pieces.count());
  for (Index t = 0; t < pieces.mesh.triangles.size(); ++t)
    pieces.triangle[pieces.components.of_vertex[pieces.mesh.triangles[t][0]]].push_back(t);
  pieces.rims = geometry::boundary_loops(pieces.mesh, geometry::mesh_edges(pieces.mesh));
  return pieces;
}

/// The nearest other piece of a vertex, and its triangle there.
struct Nearest {
  double distance_m = std::numeric_limits<double>::infinity();
  std::size_t piece = 0;
  Index triangle = geometry::kNoIndex;
};

/// Finds the triangle of another piece on which each vertex that is to be tacked lies.
std::vector<Nearest> find_nearest(const engine::Context& context, const Pieces& pieces, double within_m) {
  std::vector<Nearest> nearest(pieces.mesh.positions.size());
  std::vector<bool> on_rim(nearest.size(), false);
  for (const std::vector<Index>& rim : pieces.rims)
    for (const Index v : rim) on_rim[v] = true;
  for (std::size_t k = 0; k < pieces.count(); ++k) {
    geometry::TriMesh piece{.positions = pieces.mesh.positions, .triangles = {}};
    for (const Index t : pieces.triangle[k]) piece.triangles.push_back(pieces.mesh.triangles[t]);
    const geometry::MeshDistance distance(context, piece);
    engine::parallel_for(context, nearest.size(), kRimGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) {
        const std::size_t own = pieces.components.of_vertex[v];
        if (own == k || !(on_rim[v] || pieces.is_below(kSmallPiece, own))) continue;
        const auto at = distance.closest_point_within(pieces.mesh.positions[v], within_m);
        if (at && at->triangle != geometry::kNoIndex && at->signed_distance < nearest[v].distance_m)
          nearest[v] = {at->signed_distance, k, pieces.triangle[k][at->triangle]};
      }
    });
  }
  return nearest;
}

/// Leaves out what touches by chance.
void keep_seams(const Pieces& pieces, std::vector<Nearest>& nearest) {
  for (const std::vector<Index>& rim : pieces.rims) {
    if (pieces.is_below(kStrap, pieces.components.of_vertex[rim.front()])) continue;
    const auto near =
        std::ranges::count_if(rim, [&](Index v) { return nearest[v].triangle != geometry::kNoIndex; });
    if (static_cast<double>(near) >= kSeam * static_cast<double>(rim.size())) continue;
    for (const Index v : rim) nearest[v] = {};
  }
}

}  // namespace

Tacking find_tacks(const engine::Context& context, const geometry::TriMesh& garment, double within_m) {
  Tacking tacking;
  if (!(within_m > 0.0)) return tacking;
  const auto welded = geometry::repair(context, garment, {.orient = false, .drop_fins = false});
  if (!welded) return tacking;
  const Pieces pieces = cut(*welded);
  if (pieces.count() < 2) return tacking;
  std::vector<Nearest> nearest = find_nearest(context, pieces, within_m);
  keep_seams(pieces, nearest);
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> points;
  for (std::size_t v = 0; v < nearest.size(); ++v) {
    if (nearest[v].triangle == geometry::kNoIndex) continue;
    for (const Index corner : pieces.mesh.triangles[nearest[v].triangle])
      tacking.tacks.push_back({pieces.input[v], pieces.input[corner]});
    ++points[{pieces.components.of_vertex[v], nearest[v].piece}];
  }
  for (const auto& [pair, count] : points)
    tacking.pieces.push_back({.piece = pair.first + 1, .onto = pair.second + 1, .points = count});
  return tacking;
}

}  // namespace bodice::tryon
