#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include <bodice/geometry/crossings.hpp>
#include <bodice/geometry/mesh_repair.hpp>
#include <bodice/tryon/layers.hpp>

#include "garment/outward.hpp"

namespace bodice::inline v0_1::tryon {
namespace {

using geometry::Index;
using geometry::Vec3;
using Crossings = std::vector<std::array<std::size_t, 2>>;

// The most rounds, and the most of them that do not leave fewer pairs.
constexpr int kMostRounds = 30, kVainRounds = 8;
// The rings of triangles around a line of crossing that decide which layer is the outer one, and the distance
// within which a vertex there lies over the other layer.
constexpr int kRings = 5;
constexpr double kLayersWithin_m = 0.01;
constexpr double kFarthestMove_m = 0.015;  // limits how much a garment changes
// A vertex lies over a point that is aside by no more than its height and this.
constexpr double kAside_m = 0.001;
// The rings of triangles around a fold that crosses itself which are smoothed, and the share of the distance
// to the mean of its neighbors by which a vertex moves. Larger ones leave edges that are much shorter at
// rest.
constexpr int kSmoothedRings = 2;
constexpr double kSmoothing = 0.3;
// The distance from the skin that smoothing leaves, unless a vertex was nearer.
constexpr double kLeastToSkin_m = 0.004;

/// The triangles around each vertex, the pieces that they join, and the vertices at each position.
struct Topology {
  std::vector<std::vector<Index>> triangles;  // #V
  std::vector<Index> piece;                   // #V
  std::vector<Index> first_copy;              // #V: the first vertex at the same position

  explicit Topology(const geometry::TriMesh& mesh)
      : triangles(mesh.positions.size()), piece(geometry::connected_components(mesh).of_vertex) {
    for (Index t = 0; t < mesh.triangles.size(); ++t)
      for (const Index v : mesh.triangles[t]) triangles[v].push_back(t);
    std::map<std::array<double, 3>, Index> first;
    for (Index v = 0; v < mesh.positions.size(); ++v) {
      const Vec3& p = mesh.positions[v];
      first_copy.push_back(p.allFinite() ? first.try_emplace({p.x(), p.y(), p.z()}, v).first->second : v);
    }
  }
};

/// One of the two layers along a line of crossing.
struct Layer {
  Index line = geometry::kNoIndex;
  bool second = false;

  bool operator==(const Layer&) const = default;
  bool exists() const { return line != geometry::kNoIndex; }
  Layer other() const { return {line, !second}; }
};

/// The layers to which the triangles near lines of crossing belong. All lines of two pieces count as one.
class Layers {
 public:
  Layers(const geometry::TriMesh& mesh, const Topology& topology, const Crossings& crossings)
      : mesh_(mesh),
        topology_(topology),
        of_(mesh.triangles.size()),
        ring_(mesh.triangles.size(), 0),
        crossed_(mesh.triangles.size()) {
    for (const auto& [a, b] : crossings) {
      crossed_[a].push_back(static_cast<Index>(b));
      crossed_[b].push_back(static_cast<Index>(a));
    }
    for (const auto& [a, b] : crossings)
      if (piece_of(a) != piece_of(b)) add_pieces(a, b);
    for (const auto& [a, b] : crossings)
      if (piece_of(a) == piece_of(b) && !of_[a].exists()) follow(static_cast<Index>(a));
    grow();
  }

  std::size_t lines() const { return is_fold_.size(); }
  /// The layer of a triangle, unless it is near no line, or near one along which a fold crosses itself.
  Layer of_triangle(Index t) const { return of_[t].exists() && !is_fold_[of_[t].line] ? of_[t] : Layer{}; }
  Layer of_vertex(Index v) const {
    for (const Index t : topology_.triangles[v])
      if (const Layer layer = of_triangle(t); layer.exists()) return layer;
    return {};
  }
  /// The vertices around folds that cross themselves.
  std::vector<Index> vertices_of_folds() const {
    std::vector<Index> vertices;
    for (const Index t : added_)
      if (is_fold_[of_[t].line] && ring_[t] <= kSmoothedRings)
        vertices.insert(vertices.end(), mesh_.triangles[t].begin(), mesh_.triangles[t].end());
    std::ranges::sort(vertices);
    const auto repeated = std::ranges::unique(vertices);
    vertices.erase(repeated.begin(), repeated.end());
    return vertices;
  }
  bool is_corner_of_crossing(Index v) const {
    return std::ranges::any_of(topology_.triangles[v], [&](Index t) { return !crossed_[t].empty(); });
  }

 private:
  Index piece_of(std::size_t t) const { return topology_.piece[mesh_.triangles[t][0]]; }

  Index add_line() {
    is_fold_.push_back(false);
    return static_cast<Index>(is_fold_.size() - 1);
  }

  void add(Index t, Layer layer) {
    of_[t] = layer;
    added_.push_back(t);
  }

  void add_pieces(std::size_t a, std::size_t b) {
    const std::pair<Index, Index> pieces = std::minmax({piece_of(a), piece_of(b)});
    const auto [line, is_new] = line_of_pieces_.try_emplace(pieces, geometry::kNoIndex);
    if (is_new) line->second = add_line();
    for (const std::size_t t : {a, b})
      if (!of_[t].exists()) add(static_cast<Index>(t), {line->second, piece_of(t) == pieces.second});
  }

  // Follows a line along which a piece crosses itself. Triangles that cross are of different layers, and
  // neighbors of the same one. Where this is a contradiction, the line is in a fold.
  void follow(Index from) {
    const Index line = add_line();
    std::size_t k = added_.size();
    add(from, {line, false});
    const auto reach = [&](Index t, Layer layer) {
      if (!of_[t].exists()) add(t, layer);
      if (of_[t] != layer) is_fold_[line] = true;
    };
    for (; k < added_.size(); ++k) {
      const Index t = added_[k];
      for (const Index crossed : crossed_[t]) reach(crossed, of_[t].other());
      for (const Index v : mesh_.triangles[t])
        for (const Index neighbor : topology_.triangles[v])
          if (!crossed_[neighbor].empty()) reach(neighbor, of_[t]);
    }
  }

  void grow() {
    std::size_t begin = 0;
    for (int ring = 0; ring < kRings; ++ring) {
      const std::size_t end = added_.size();
      for (; begin < end; ++begin)
        for (const Index v : mesh_.triangles[added_[begin]])
          for (const Index neighbor : topology_.triangles[v])
            if (!of_[neighbor].exists()) {
              add(neighbor, of_[added_[begin]]);
              ring_[neighbor] = ring + 1;
            }
    }
  }

  const geometry::TriMesh& mesh_;
  const Topology& topology_;
  std::vector<Layer> of_;                                    // #T
  std::vector<int> ring_;                                    // #T: rings between it and a crossing
  std::vector<std::vector<Index>> crossed_;                  // #T: the triangles that each crosses
  std::vector<Index> added_;                                 // triangles with a layer
  std::map<std::pair<Index, Index>, Index> line_of_pieces_;  // by the numbers of two pieces
  std::vector<bool> is_fold_;                                // #lines
};

/// A vertex near a line of crossing, and its height over the other layer, meters.
struct NearLine {
  Index vertex = 0;
  Layer layer;
  Vec3 out;
  double above_m = 0.0;
};

std::vector<NearLine> vertices_near_lines(const engine::Context& context, const geometry::MeshDistance& skin,
                                          const geometry::TriMesh& mesh, const Layers& layers) {
  const geometry::MeshDistance distance(context, mesh);
  std::vector<NearLine> near;
  for (Index v = 0; v < mesh.positions.size(); ++v) {
    const Vec3& p = mesh.positions[v];
    const Layer own = layers.of_vertex(v);
    if (!own.exists() || !p.allFinite()) continue;
    const auto is_of_other = [&](Index t) { return layers.of_triangle(t) == own.other(); };
    const auto at = distance.closest_point_within(p, kLayersWithin_m, is_of_other);
    if (!at) continue;
    const Vec3 out = outward(skin, p), by = p - at->point;
    const double above_m = by.dot(out), aside_m = (by - above_m * out).norm();
    if (aside_m <= std::abs(above_m) + kAside_m || layers.is_corner_of_crossing(v))
      near.push_back({v, own, out, above_m});
  }
  return near;
}

/// Whether the second layer of each line is the outer one: that which was moved before, or else that which
/// lies higher.
std::vector<bool> second_is_outer(std::span<const NearLine> near, std::size_t lines,
                                  std::span<const Vec3> start, std::span<const Vec3> positions) {
  std::vector<double> above_m(lines, 0.0), moved_m(lines, 0.0);
  for (const NearLine& v : near) {
    const double sign = v.layer.second ? 1.0 : -1.0;
    above_m[v.layer.line] += sign * v.above_m;
    moved_m[v.layer.line] += sign * (positions[v.vertex] - start[v.vertex]).norm();
  }
  std::vector<bool> second(lines);
  for (std::size_t line = 0; line < lines; ++line)
    second[line] = (moved_m[line] != 0.0 ? moved_m[line] : above_m[line]) > 0.0;
  return second;
}

/// Moves vertices of outer layers that are below the other layer, or at the line itself, until they are
/// `gap_m` over it; returns whether any moved.
bool lift_outer_layers(std::span<const NearLine> near, const Layers& layers, const Topology& topology,
                       double gap_m, std::span<const Vec3> start, std::vector<Vec3>& positions) {
  const std::vector<bool> second = second_is_outer(near, layers.lines(), start, positions);
  std::map<Index, Vec3> lifts;  // by the first vertex at a position
  for (const NearLine& v : near) {
    const bool below = v.above_m < 0.0 || (v.above_m < gap_m && layers.is_corner_of_crossing(v.vertex));
    if (v.layer.second != second[v.layer.line] || !below) continue;
    const Vec3 lift = (gap_m - v.above_m) * v.out;
    if ((positions[v.vertex] + lift - start[v.vertex]).norm() > kFarthestMove_m) continue;
    Vec3& longest = lifts.try_emplace(topology.first_copy[v.vertex], Vec3::Zero()).first->second;
    if (lift.squaredNorm() > longest.squaredNorm()) longest = lift;
  }
  for (Index v = 0; v < positions.size(); ++v)
    if (const auto lift = lifts.find(topology.first_copy[v]); lift != lifts.end())
      positions[v] += lift->second;
  return !lifts.empty();
}

/// Moves the vertices around folds that cross themselves to the mean of their neighbors, and out of the skin.
/// That spans a crease of the body, of which both sides were pushed into each other. Returns whether any
/// moved.
bool smooth_folds(const geometry::MeshDistance& skin, const geometry::TriMesh& mesh, const Layers& layers,
                  const Topology& topology, std::span<const Vec3> start, std::vector<Vec3>& positions) {
  std::map<Index, Vec3> moved;  // by the first vertex at a position
  for (const Index v : layers.vertices_of_folds()) {
    if (!positions[v].allFinite() || moved.contains(topology.first_copy[v])) continue;
    Vec3 sum = Vec3::Zero();
    double count = 0.0;
    for (const Index t : topology.triangles[v])
      for (const Index n : mesh.triangles[t]) sum += positions[n], ++count;
    Vec3 to = positions[v] + kSmoothing * (sum / count - positions[v]);
    const double least_m = std::min(skin.signed_distance(start[v]), kLeastToSkin_m);
    to += std::max(0.0, least_m - skin.signed_distance(to)) * outward(skin, to);
    if ((to - start[v]).norm() <= kFarthestMove_m) moved.emplace(topology.first_copy[v], to);
  }
  for (Index v = 0; v < positions.size(); ++v)
    if (const auto to = moved.find(topology.first_copy[v]); to != moved.end()) positions[v] = to->second;
  return !moved.empty();
}

}  // namespace

SeparatedLayers separate_layers(const engine::Context& context, const geometry::MeshDistance& skin,
                                double gap_m, geometry::TriMesh& garments) {
  Crossings crossings = geometry::find_crossings(garments.positions, garments.triangles);
  SeparatedLayers result{crossings.size(), crossings.size()};
  if (crossings.empty()) return result;
  const Topology topology(garments);
  const std::vector<Vec3> start = garments.positions;
  std::vector<Vec3> best = start;
  int in_vain = 0;
  for (int round = 0; round < kMostRounds && in_vain < kVainRounds && !crossings.empty(); ++round) {
    const Layers layers(garments, topology, crossings);
    const auto near = vertices_near_lines(context, skin, garments, layers);
    const bool lifted = lift_outer_layers(near, layers, topology, gap_m, start, garments.positions);
    if (!smooth_folds(skin, garments, layers, topology, start, garments.positions) && !lifted) break;
    crossings = geometry::find_crossings(garments.positions, garments.triangles);
    ++in_vain;
    if (crossings.size() >= result.after) continue;
    in_vain = 0;
    result.after = crossings.size();
    best = garments.positions;
  }
  garments.positions = std::move(best);
  return result;
}

}  // namespace bodice::tryon
