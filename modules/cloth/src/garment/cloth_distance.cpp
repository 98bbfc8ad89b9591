// Based on: Edsger Dijkstra. A Note on Two Problems in Connexion with Graphs. 1959.
// Differs: steps also cross pairs of triangles that are unfolded into a plane; paths along edges are 4 % too
// long on average.
#include "garment/cloth_distance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace bodice::inline v0_1::cloth {
namespace {

using geometry::Vec3;

constexpr double kFar = std::numeric_limits<double>::infinity();

// The distance of the corners c and d with both triangles unfolded into a plane; infinite if the straight
// line between them misses the edge (a, b).
double unfolded(const geometry::TriMesh& mesh, const Hinge& h) {
  const Vec3& a = mesh.positions[h.a];
  const Vec3 edge = mesh.positions[h.b] - a, c = mesh.positions[h.c] - a, d = mesh.positions[h.d] - a;
  const double length = edge.norm();
  const double cx = c.dot(edge) / length, dx = d.dot(edge) / length;
  const double cy = std::sqrt(std::max(0.0, c.squaredNorm() - cx * cx));
  const double dy = std::sqrt(std::max(0.0, d.squaredNorm() - dx * dx));
  const double cross = cx + (dx - cx) * cy / (cy + dy);
  if (!(cross >= 0.0 && cross <= length)) return kFar;
  return std::hypot(dx - cx, cy + dy);
}

}  // namespace

ClothDistance::ClothDistance(const geometry::TriMesh& mesh, const Topology& topology)
    : begin_(mesh.positions.size() + 1, 0), distance_(mesh.positions.size(), kFar) {
  std::vector<std::tuple<Index, Index, double>> links;
  for (const Edge& e : topology.edges) {
    links.emplace_back(e.a, e.b, (mesh.positions[e.a] - mesh.positions[e.b]).norm());
  }
  for (const Hinge& h : topology.hinges) {
    const double length = unfolded(mesh, h);
    if (length < kFar) links.emplace_back(h.c, h.d, length);
  }
  for (const auto& [a, b, length] : links) ++begin_[a + 1], ++begin_[b + 1];
  for (std::size_t i = 1; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
  step_.resize(2 * links.size());
  std::vector<Index> next(begin_.begin(), begin_.end() - 1);
  for (const auto& [a, b, length] : links) {
    step_[next[a]++] = {b, length};
    step_[next[b]++] = {a, length};
  }
}

const std::vector<std::pair<double, Index>>& ClothDistance::within(Index from, double radius_m) {
  found_.clear();
  heap_.assign(1, {0.0, from});
  distance_[from] = 0.0;
  std::vector<Index> touched = {from};
  while (!heap_.empty()) {
    std::pop_heap(heap_.begin(), heap_.end(), std::greater<>());
    const auto [d, i] = heap_.back();
    heap_.pop_back();
    if (d > distance_[i]) continue;
    found_.emplace_back(d, i);
    for (Index s = begin_[i]; s < begin_[i + 1]; ++s) {
      const auto [to, length] = step_[s];
      if (d + length > radius_m || d + length >= distance_[to]) continue;
      if (distance_[to] == kFar) touched.push_back(to);
      distance_[to] = d + length;
      heap_.emplace_back(distance_[to], to);
      std::push_heap(heap_.begin(), heap_.end(), std::greater<>());
    }
  }
  for (const Index i : touched) distance_[i] = kFar;
  return found_;
}

}  // namespace bodice::cloth
