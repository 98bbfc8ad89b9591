#include <algorithm>
#include <cmath>

#include <bodice/geodesic/isoline.hpp>

namespace bodice::inline v0_1::geodesic {
namespace {

using geometry::Index;
using geometry::kNoIndex;
using geometry::Vec3;

/// The triangles that each level crosses, in compressed rows.
struct Crossed {
  std::vector<std::size_t> offset;
  std::vector<Index> triangles;
};

struct Crossing {
  std::size_t level;
  Index triangle;
};

/// A level crosses a triangle if it is above the least value at a corner and not above the greatest.
/// Precondition: levels are sorted.
std::vector<Crossing> find_crossings(const geometry::TriMesh& mesh, std::span<const float> field,
                                     std::span<const float> levels) {
  std::vector<Crossing> found;
  const float lowest = levels.front(), highest = levels.back();
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    const auto& t = mesh.triangles[f];
    const float a = field[t[0]], b = field[t[1]], c = field[t[2]];
    const float low = std::min(std::min(a, b), c), high = std::max(std::max(a, b), c);
    if (high < lowest || low >= highest || !std::isfinite(a + b + c)) continue;
    const auto first = std::upper_bound(levels.begin(), levels.end(), low);
    for (auto it = first; it != levels.end() && *it <= high; ++it)
      found.push_back({static_cast<std::size_t>(it - levels.begin()), static_cast<Index>(f)});
  }
  return found;
}

Crossed crossed_triangles(const geometry::TriMesh& mesh, std::span<const float> field,
                          std::span<const float> levels) {
  const std::vector<Crossing> found = find_crossings(mesh, field, levels);
  Crossed crossed;
  crossed.offset.assign(levels.size() + 1, 0);
  for (const Crossing& crossing : found) ++crossed.offset[crossing.level + 1];
  for (std::size_t i = 1; i <= levels.size(); ++i) crossed.offset[i] += crossed.offset[i - 1];
  crossed.triangles.resize(found.size());
  std::vector<std::size_t> next(crossed.offset.begin(), crossed.offset.end() - 1);
  for (const Crossing& crossing : found) crossed.triangles[next[crossing.level]++] = crossing.triangle;
  return crossed;
}

class Tracer {
 public:
  Tracer(const geometry::TriMesh& mesh, const geometry::MeshEdges& edges, std::span<const float> field)
      : mesh_(mesh), edges_(edges), field_(field), done_(mesh.triangles.size(), 0) {}

  std::vector<Isoline> trace(float level, std::span<const Index> triangles) {
    level_ = level;
    std::vector<Isoline> lines;
    for (const Index f : triangles)
      if (!done_[f]) lines.push_back(trace_from(f));
    for (const Index f : triangles) done_[f] = 0;
    return lines;
  }

 private:
  bool crosses(Index e) const {
    const auto [a, b] = edges_.ends[e];
    return (field_[a] >= level_) != (field_[b] >= level_);
  }
  bool live(Index f) const {
    const auto& t = mesh_.triangles[f];
    return !done_[f] && std::isfinite(field_[t[0]] + field_[t[1]] + field_[t[2]]);
  }
  Index other_crossing(Index f, Index e) const {
    for (const Index other : edges_.of_triangle[f])
      if (other != e && crosses(other)) return other;
    return kNoIndex;
  }
  /// Walks from triangle f over edge e until the skin ends or a visited triangle is met. Returns whether it
  /// came back to `home`.
  bool walk(Index f, Index e, Index home, std::vector<Index>& path) {
    while (true) {
      path.push_back(e);
      const auto [g, h] = edges_.triangles[e];
      const Index next = g == f ? h : g;
      if (next == home) return true;
      if (next == kNoIndex || !live(next)) return false;
      done_[next] = 1;
      e = other_crossing(next, e);
      f = next;
      if (e == kNoIndex) return false;
    }
  }
  Isoline trace_from(Index f) {
    done_[f] = 1;
    Index first = kNoIndex, second = kNoIndex;
    for (const Index e : edges_.of_triangle[f])
      if (crosses(e)) (first == kNoIndex ? first : second) = e;
    Isoline line;
    line.closed = walk(f, first, f, line.edges);
    if (!line.closed) {
      std::reverse(line.edges.begin(), line.edges.end());
      walk(f, second, kNoIndex - 1, line.edges);
    }
    measure(line);
    return line;
  }
  void measure(Isoline& line) const {
    for (const Index e : line.edges) {
      const auto [a, b] = edges_.ends[e];
      const double t = (static_cast<double>(level_) - static_cast<double>(field_[a])) /
                       (static_cast<double>(field_[b]) - static_cast<double>(field_[a]));
      line.points.push_back(mesh_.positions[a] + t * (mesh_.positions[b] - mesh_.positions[a]));
    }
    const std::size_t n = line.points.size(), pieces = line.closed ? n : n - 1;
    Vec3 moment = Vec3::Zero();
    for (std::size_t i = 0; i < pieces; ++i) {
      const Vec3 &p = line.points[i], &q = line.points[(i + 1) % n];
      const double length = (q - p).norm();
      line.girth_m += length;
      moment += 0.5 * length * (p + q - 2.0 * line.points[0]);
    }
    line.centroid = line.points[0];
    if (line.girth_m > 0.0) line.centroid += moment / line.girth_m;
  }

  const geometry::TriMesh& mesh_;
  const geometry::MeshEdges& edges_;
  std::span<const float> field_;
  std::vector<char> done_;
  float level_ = 0.0F;
};

}  // namespace

std::vector<std::vector<Isoline>> isolines(const geometry::TriMesh& mesh, const geometry::MeshEdges& edges,
                                           std::span<const float> field, std::span<const float> levels) {
  std::vector<std::vector<Isoline>> result(levels.size());
  if (levels.empty()) return result;
  std::vector<std::size_t> order(levels.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return levels[a] < levels[b]; });
  std::vector<float> sorted(levels.size());
  for (std::size_t i = 0; i < order.size(); ++i) sorted[i] = levels[order[i]];
  const Crossed crossed = crossed_triangles(mesh, field, sorted);
  Tracer tracer(mesh, edges, field);
  for (std::size_t i = 0; i < order.size(); ++i)
    result[order[i]] = tracer.trace(
        sorted[i],
        std::span(crossed.triangles).subspan(crossed.offset[i], crossed.offset[i + 1] - crossed.offset[i]));
  return result;
}

}  // namespace bodice::geodesic
