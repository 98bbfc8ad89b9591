// Based on: Ron Kimmel, James A. Sethian. Computing geodesic paths on manifolds. 1998. - the front
// Based on: Martin Novotni, Reinhard Klein. Computing geodesic distances on triangular meshes. 2002. - the
// virtual source: the point, in the plane of a triangle, at the known distances from two of its corners
// Differs: a virtual source sees through up to kDepth further triangles, each laid flat, so that obtuse
// triangles need no special treatment.
#include "fast_marching.hpp"

#include <cmath>
#include <optional>
#include <queue>

#include <Eigen/Core>

namespace bodice::inline v0_1::geodesic {
namespace {

using geometry::Index;
using geometry::kNoIndex;
using Vec2 = Eigen::Vector2d;

/// The number of triangles beyond the front through which a source is followed. Three reach over the obtuse
/// corners of real scans.
constexpr int kDepth = 3;

/// An edge laid flat, and the two rays from the source that bound what it sees through all earlier edges.
struct Gate {
  Index edge, from_triangle;
  std::array<Index, 2> end;
  std::array<Vec2, 2> at;
  Vec2 source;
  std::array<Vec2, 2> ray;
};

double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// The point at the given distances from (0, 0) and (length, 0), on the side y < 0; none if the three lengths
/// form no triangle.
std::optional<Vec2> third_corner(double length, double from_first, double from_second) {
  const double x = (length * length + from_first * from_first - from_second * from_second) / (2.0 * length);
  const double square = from_first * from_first - x * x;
  if (!(square >= 0.0)) return std::nullopt;
  return Vec2(x, -std::sqrt(square));
}

class Front {
 public:
  Front(const geometry::TriMesh& mesh, const geometry::MeshEdges& edges,
        const geometry::EdgesOfVertex& around)
      : mesh_(mesh),
        edges_(edges),
        around_(around),
        field_(mesh.positions.size(), kUnreachable),
        settled_(mesh.positions.size(), 0) {}

  Field run(std::span<const Seed> seeds) {
    for (const Seed& seed : seeds)
      if (seed.vertex < field_.size() && seed.distance >= 0.0F) offer(seed.vertex, seed.distance);
    while (!queue_.empty()) {
      const auto [distance, v] = queue_.top();
      queue_.pop();
      if (settled_[v]) continue;
      settled_[v] = 1;
      spread(v);
    }
    return std::move(field_);
  }

 private:
  void offer(Index v, float distance) {
    if (settled_[v] || !(distance < field_[v])) return;
    field_[v] = distance;
    queue_.push({distance, v});
  }
  double length(Index edge) const {
    const auto [a, b] = edges_.ends[edge];
    return (mesh_.positions[b] - mesh_.positions[a]).norm();
  }
  void spread(Index v) {
    for (Index k = around_.offset[v]; k < around_.offset[v + 1]; ++k) {
      const Index e = around_.edge[k];
      const Index other = edges_.ends[e][0] == v ? edges_.ends[e][1] : edges_.ends[e][0];
      const double long_m = length(e);
      if (!std::isfinite(long_m)) continue;
      if (settled_[other] && long_m > 0.0)
        shine(e, long_m);
      else
        offer(other, field_[v] + static_cast<float>(long_m));
    }
  }
  /// Offers the corners beyond an edge the distance from its virtual source, once both ends are settled.
  void shine(Index e, double long_m) {
    const auto [a, b] = edges_.ends[e];
    const auto source = third_corner(long_m, static_cast<double>(field_[a]), static_cast<double>(field_[b]));
    if (!source) return;
    const std::array<Vec2, 2> at{Vec2(0.0, 0.0), Vec2(long_m, 0.0)};
    for (int k = 0; k < 2; ++k)
      if (edges_.triangles[e][k] != kNoIndex)
        pass({e, edges_.triangles[e][1 - k], {a, b}, at, *source, {at[0] - *source, at[1] - *source}},
             edges_.triangles[e][k], kDepth);
  }
  /// Follows the source through the gate into `triangle`: to its third corner, if visible, and to the two
  /// edges beyond.
  void pass(const Gate& gate, Index triangle, int depth) {
    const auto& t = mesh_.triangles[triangle];
    Index tip = kNoIndex;
    for (const Index v : t)
      if (v != gate.end[0] && v != gate.end[1]) tip = v;
    if (tip == kNoIndex) return;
    const Vec2 along = gate.at[1] - gate.at[0];
    const double long_m = along.norm();
    if (!(long_m > 0.0)) return;
    const auto flat = third_corner(long_m, (mesh_.positions[tip] - mesh_.positions[gate.end[0]]).norm(),
                                   (mesh_.positions[tip] - mesh_.positions[gate.end[1]]).norm());
    if (!flat) return;
    const Vec2 x = along / long_m, y(-x.y(), x.x());
    const Vec2 at = gate.at[0] + flat->x() * x - flat->y() * y;
    const Vec2 to_tip = at - gate.source;
    const double right = cross(gate.ray[1], to_tip), left = cross(to_tip, gate.ray[0]);
    if (right >= 0.0 && left >= 0.0) offer(tip, static_cast<float>(to_tip.norm()));
    if (depth <= 1) return;
    if (left > 0.0)
      enter(gate, triangle, {gate.end[0], tip}, {gate.at[0], at},
            {gate.ray[0], right >= 0.0 ? to_tip : gate.ray[1]}, depth);
    if (right > 0.0)
      enter(gate, triangle, {tip, gate.end[1]}, {at, gate.at[1]},
            {left >= 0.0 ? to_tip : gate.ray[0], gate.ray[1]}, depth);
  }
  void enter(const Gate& gate, Index triangle, const std::array<Index, 2>& end, const std::array<Vec2, 2>& at,
             const std::array<Vec2, 2>& ray, int depth) {
    for (const Index e : edges_.of_triangle[triangle]) {
      const auto& ends = edges_.ends[e];
      if (!((ends[0] == end[0] && ends[1] == end[1]) || (ends[0] == end[1] && ends[1] == end[0]))) continue;
      const auto [f, g] = edges_.triangles[e];
      const Index next = f == triangle ? g : f;
      if (next != kNoIndex) pass({e, triangle, end, at, gate.source, ray}, next, depth - 1);
      return;
    }
  }

  using Entry = std::pair<float, Index>;
  const geometry::TriMesh& mesh_;
  const geometry::MeshEdges& edges_;
  const geometry::EdgesOfVertex& around_;
  Field field_;
  std::vector<char> settled_;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
};

}  // namespace

Field fast_marching(const geometry::TriMesh& mesh, const geometry::MeshEdges& edges,
                    const geometry::EdgesOfVertex& around, std::span<const Seed> seeds) {
  return Front(mesh, edges, around).run(seeds);
}

}  // namespace bodice::geodesic
