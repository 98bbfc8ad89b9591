// Exact geodesic distances by windows in a priority queue, filtered by the distances of the corners.
// Based on: Joseph Mitchell, David Mount, Christos Papadimitriou. The discrete geodesic problem. 1987.
// Based on: Shi-Qing Xin, Guo-Jin Wang. Improving Chen and Han's algorithm on the discrete geodesic problem.
// 2009.
#include <bench_references/exact_geodesic.hpp>

#include <cmath>
#include <limits>
#include <numbers>
#include <queue>

#include <Eigen/Core>

namespace bench {
namespace {

using bodice::geometry::EdgesOfVertex;
using bodice::geometry::Index;
using bodice::geometry::kNoIndex;
using bodice::geometry::MeshEdges;
using bodice::geometry::TriMesh;
using Vec2 = Eigen::Vector2d;

constexpr double kFar = std::numeric_limits<double>::infinity();

/// An interval [from, to] of an edge, laid on the x axis from its first end. A source at (x, y < 0), already
/// at distance `so_far`, sees the interval and through it `triangle`.
struct Window {
  Index edge, triangle;
  bool flipped;  ///< the x axis starts at the edge's second end
  double from, to;
  Vec2 source;
  double so_far, least;
  bool operator<(const Window& other) const { return least > other.least; }
};

double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

class Exact {
 public:
  Exact(const TriMesh& mesh, const MeshEdges& edges)
      : mesh_(mesh),
        edges_(edges),
        around_(bodice::geometry::edges_of_vertex(mesh.positions.size(), edges)),
        distance_(mesh.positions.size(), kFar),
        angle_(mesh.positions.size(), 0.0) {
    for (const auto& t : mesh.triangles)
      for (int k = 0; k < 3; ++k) {
        const auto a = mesh.positions[t[(k + 1) % 3]] - mesh.positions[t[k]];
        const auto b = mesh.positions[t[(k + 2) % 3]] - mesh.positions[t[k]];
        angle_[t[k]] += std::atan2(a.cross(b).norm(), a.dot(b));
      }
  }

  std::vector<double> run(Index source) {
    reach(source, 0.0);
    while (!windows_.empty() || !corners_.empty()) {
      if (windows_.empty() || (!corners_.empty() && corners_.top().first <= windows_.top().least)) {
        const auto [d, v] = corners_.top();
        corners_.pop();
        if (d == distance_[v]) start(v, v == source);
      } else {
        const Window window = windows_.top();
        windows_.pop();
        pass(window);
      }
    }
    return std::move(distance_);
  }

 private:
  void reach(Index v, double d) {
    if (!(d < distance_[v])) return;
    distance_[v] = d;
    corners_.push({d, v});
  }
  double length(Index e) const {
    return (mesh_.positions[edges_.ends[e][1]] - mesh_.positions[edges_.ends[e][0]]).norm();
  }
  /// Starts windows at a vertex. Shortest paths bend only at vertices with more than a full turn around them.
  void start(Index v, bool source) {
    for (Index k = around_.offset[v]; k < around_.offset[v + 1]; ++k) {
      const Index e = around_.edge[k];
      reach(edges_.ends[e][0] == v ? edges_.ends[e][1] : edges_.ends[e][0], distance_[v] + length(e));
    }
    if (!source && angle_[v] < 2.0 * std::numbers::pi - 1e-9) return;
    for (Index k = around_.offset[v]; k < around_.offset[v + 1]; ++k)
      for (const Index f : edges_.triangles[around_.edge[k]]) {
        if (f == kNoIndex) continue;
        for (const Index e : edges_.of_triangle[f])
          if (edges_.ends[e][0] != v && edges_.ends[e][1] != v) shine_from(v, e, f);
      }
  }
  void shine_from(Index v, Index e, Index f) {
    const double long_m = length(e);
    const auto [a, b] = edges_.ends[e];
    const Vec2 at = lay(long_m, (mesh_.positions[v] - mesh_.positions[a]).norm(),
                        (mesh_.positions[v] - mesh_.positions[b]).norm(), -1.0);
    push(e, f, false, 0.0, long_m, at, distance_[v]);
  }
  static Vec2 lay(double long_m, double first, double second, double side) {
    const double x = (long_m * long_m + first * first - second * second) / (2.0 * long_m);
    return {x, side * std::sqrt(std::max(0.0, first * first - x * x))};
  }
  /// Adds a window that leaves triangle f over edge e.
  void push(Index e, Index f, bool flipped, double from, double to, const Vec2& source, double so_far) {
    const auto [g, h] = edges_.triangles[e];
    const Index next = g == f ? h : g;
    if (next == kNoIndex || !(to - from > 1e-9 * length(e))) return;
    const double x = std::clamp(source.x(), from, to);
    windows_.push({e, next, flipped, from, to, source, so_far, so_far + (Vec2(x, 0.0) - source).norm()});
  }
  void pass(const Window& w) {
    const auto& t = mesh_.triangles[w.triangle];
    const double long_m = length(w.edge);
    const Index first = edges_.ends[w.edge][w.flipped ? 1 : 0],
                second = edges_.ends[w.edge][w.flipped ? 0 : 1];
    Index tip = kNoIndex;
    for (const Index v : t)
      if (v != first && v != second) tip = v;
    const Vec2 at = lay(long_m, (mesh_.positions[tip] - mesh_.positions[first]).norm(),
                        (mesh_.positions[tip] - mesh_.positions[second]).norm(), 1.0);
    const Vec2 left(w.from, 0.0), right(w.to, 0.0);
    const double to_left = w.so_far + (left - w.source).norm(),
                 to_right = w.so_far + (right - w.source).norm();
    const double slack = 1e-10 * long_m;
    if (distance_[first] + w.to < to_right - slack || distance_[second] + long_m - w.from < to_left - slack ||
        distance_[tip] + (left - at).norm() < to_left - slack ||
        distance_[tip] + (right - at).norm() < to_right - slack)
      return;
    const Vec2 ray_left = left - w.source, ray_right = right - w.source, to_tip = at - w.source;
    const double past_right = cross(ray_right, to_tip), past_left = cross(to_tip, ray_left);
    if (past_right >= -slack * to_tip.norm() && past_left >= -slack * to_tip.norm())
      reach(tip, w.so_far + to_tip.norm());
    if (past_left > 0.0)
      child(w, first, tip, Vec2(0.0, 0.0), at, ray_left, past_right >= 0.0 ? to_tip : ray_right);
    if (past_right > 0.0)
      child(w, tip, second, at, Vec2(long_m, 0.0), past_left >= 0.0 ? to_tip : ray_left, ray_right);
  }
  /// Clips the window's two rays to the edge between corners a (left) and b.
  void child(const Window& w, Index a, Index b, const Vec2& at_a, const Vec2& at_b, const Vec2& ray_left,
             const Vec2& ray_right) {
    for (const Index e : edges_.of_triangle[w.triangle]) {
      const auto& ends = edges_.ends[e];
      if (!((ends[0] == a && ends[1] == b) || (ends[0] == b && ends[1] == a))) continue;
      const double long_m = (at_b - at_a).norm();
      const Vec2 x = (at_b - at_a) / long_m, y(-x.y(), x.x());
      const auto meet = [&](const Vec2& ray) {
        const double s = cross(w.source - at_a, ray) / cross(x, ray);
        return std::clamp(s, 0.0, long_m);
      };
      const Vec2 from_a = w.source - at_a;
      push(e, w.triangle, ends[0] == b, meet(ray_left), meet(ray_right), Vec2(from_a.dot(x), from_a.dot(y)),
           w.so_far);
    }
  }

  const TriMesh& mesh_;
  const MeshEdges& edges_;
  EdgesOfVertex around_;
  std::vector<double> distance_, angle_;
  using Corner = std::pair<double, Index>;
  std::priority_queue<Corner, std::vector<Corner>, std::greater<>> corners_;
  std::priority_queue<Window> windows_;
};

}  // namespace

std::vector<double> exact_distances(const TriMesh& mesh, const MeshEdges& edges, Index source) {
  return Exact(mesh, edges).run(source);
}

}  // namespace bench
