#include <bodice/tryon/tack.hpp>

#include <algorithm>
#include <map>

#include <bodice/engine/parallel.hpp>
#include <bodice/geodesic/distance.hpp>
#include <bodice/geometry/mesh_distance.hpp>
#include <bodice/geometry/mesh_edges.hpp>
#include <bodice/geometry/mesh_repair.hpp>

namespace bodice::inline v0_1::tryon {
namespace {

using geometry::Index;

// Shares of the largest piece's area below which a piece is small (a button, a buckle, a pocket), or a strap
// or belt.
constexpr double kSmallPiece = 0.03, kStrap = 0.2;
// A rim of a larger piece is a seam, and is tacked, if at least this share of it lies on another piece. With
// less, layers touch by chance, as a shirt's hem touches the trousers.
constexpr double kSeam = 0.3;
// The same share for a rim on its own piece, as that of a bodice on a skirt which a few triangles join to it.
// The hem of a sleeve touches the trunk with a smaller share.
constexpr double kOwnSeam = 0.6;
// A rim lies on its own piece under two conditions. The distance along the cloth is at least kAlongCloth
// times the distance allowed across. And the layer below ends in a rim within kOverlapWidth times that
// distance, which is not so below a collar.
constexpr double kAlongCloth = 5.0, kOverlapWidth = 8.0;
constexpr std::size_t kRimGrain = 64;

/// The welded garment, cut into its pieces.
struct Pieces {
  geometry::TriMesh mesh;
  geometry::Components components;
  std::vector<Index> input;              // #V of the mesh: a vertex of the garment
  std::vector<std::vector<Index>> rims;  // chains of vertices

  std::size_t count() const { return components.area.size(); }
  std::size_t of_vertex(std::size_t v) const { return components.of_vertex[v]; }
  std::size_t of_triangle(Index t) const { return of_vertex(mesh.triangles[t][0]); }
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
  pieces.rims = geometry::boundary_loops(pieces.mesh, geometry::mesh_edges(pieces.mesh));
  return pieces;
}

/// The piece that a vertex lies on, and the triangle there; kNoIndex if it lies on none.
struct Nearest {
  std::size_t piece = 0;
  Index triangle = geometry::kNoIndex;
};

/// Finds the triangle on which each vertex that is to be tacked lies: of another piece, or of its own where
/// that is far along the cloth.
class NearestLayers {
 public:
  NearestLayers(const engine::Context& context, const Pieces& pieces, double within_m)
      : pieces_(pieces),
        within_m_(within_m),
        distance_(context, pieces.mesh),
        graph_(geodesic::edge_graph(context, pieces.mesh, geometry::mesh_edges(pieces.mesh),
                                    geodesic::Metric::kEdges)) {}

  std::vector<Nearest> find(const engine::Context& context) const {
    std::vector<Nearest> nearest(pieces_.mesh.positions.size());
    std::vector<bool> on_rim(nearest.size(), false);
    for (const std::vector<Index>& rim : pieces_.rims)
      for (const Index v : rim) on_rim[v] = true;
    engine::parallel_for(context, nearest.size(), kRimGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v)
        if (on_rim[v] || pieces_.is_below(kSmallPiece, pieces_.of_vertex(v)))
          nearest[v] = find(static_cast<Index>(v));
    });
    return nearest;
  }

 private:
  Nearest find(Index v) const {
    const std::size_t own = pieces_.of_vertex(v);
    // A small piece or a strap lies on others, and never on itself.
    const bool has_layers = !pieces_.is_below(kStrap, own);
    geodesic::Field along;
    const auto counts = [&](Index t) {
      if (pieces_.of_triangle(t) != own) return true;
      if (!has_layers) return false;
      if (along.empty()) along = near_along_cloth(v, kAlongCloth * within_m_);
      return std::ranges::all_of(pieces_.mesh.triangles[t], [&](Index c) { return is_far(along, c); });
    };
    const auto at = distance_.closest_point_within(pieces_.mesh.positions[v], within_m_, counts);
    if (!at || at->triangle == geometry::kNoIndex) return {};
    const std::size_t onto = pieces_.of_triangle(at->triangle);
    if (onto == own && !other_layer_ends_near(v)) return {};
    return {onto, at->triangle};
  }

  static bool is_far(const geodesic::Field& along, Index v) { return along[v] == geodesic::kUnreachable; }

  geodesic::Field near_along_cloth(Index v, double within_m) const {
    const geodesic::Seed start{v, 0.0f};
    return geodesic::distances_within(graph_, {&start, 1}, static_cast<float>(within_m));
  }

  /// Whether another layer of the piece ends near a vertex of its rim: a rim is near in space, and at least
  /// twice as far along the cloth.
  bool other_layer_ends_near(Index v) const {
    const double overlap_m = kOverlapWidth * within_m_;
    const geodesic::Field along = near_along_cloth(v, 2.0 * overlap_m);
    const auto is_other_end = [&](Index other) {
      return pieces_.of_vertex(other) == pieces_.of_vertex(v) && is_far(along, other) &&
             (pieces_.mesh.positions[other] - pieces_.mesh.positions[v]).norm() <= overlap_m;
    };
    return std::ranges::any_of(
        pieces_.rims, [&](const std::vector<Index>& rim) { return std::ranges::any_of(rim, is_other_end); });
  }

  const Pieces& pieces_;
  const double within_m_;
  geometry::MeshDistance distance_;
  geodesic::EdgeGraph graph_;
};

/// Drops the vertices of rims that are no seams.
void keep_seams(const Pieces& pieces, std::vector<Nearest>& nearest) {
  for (const std::vector<Index>& rim : pieces.rims) {
    const std::size_t own = pieces.of_vertex(rim.front());
    if (pieces.is_below(kStrap, own)) continue;
    for (const bool on_own : {false, true}) {
      const auto counts = [&](Index v) {
        return nearest[v].triangle != geometry::kNoIndex && (nearest[v].piece == own) == on_own;
      };
      const auto near = static_cast<double>(std::ranges::count_if(rim, counts));
      if (near >= (on_own ? kOwnSeam : kSeam) * static_cast<double>(rim.size())) continue;
      for (const Index v : rim)
        if (counts(v)) nearest[v] = {};
    }
  }
}

}  // namespace

Tacking find_tacks(const engine::Context& context, const geometry::TriMesh& garment, double within_m) {
  Tacking tacking;
  if (!(within_m > 0.0)) return tacking;
  const auto welded = geometry::repair(context, garment, {.orient = false, .drop_fins = false});
  if (!welded) return tacking;
  const Pieces pieces = cut(*welded);
  std::vector<Nearest> nearest = NearestLayers(context, pieces, within_m).find(context);
  keep_seams(pieces, nearest);
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> points;
  for (std::size_t v = 0; v < nearest.size(); ++v) {
    if (nearest[v].triangle == geometry::kNoIndex) continue;
    for (const Index corner : pieces.mesh.triangles[nearest[v].triangle])
      tacking.tacks.push_back({pieces.input[v], pieces.input[corner]});
    ++points[{pieces.of_vertex(v), nearest[v].piece}];
  }
  for (const auto& [pair, count] : points)
    tacking.pieces.push_back({.piece = pair.first + 1, .onto = pair.second + 1, .points = count});
  return tacking;
}

}  // namespace bodice::tryon
