#include <bodice/geometry/crossings.hpp>

#include <algorithm>

namespace bodice::inline v0_1::geometry {
namespace {

struct Corners {
  Vec3 a, b, c;

  bool has(const Vec3& p) const { return p == a || p == b || p == c; }
};

bool passes_through(const Vec3& from, const Vec3& to, const Corners& t) {
  if (t.has(from) || t.has(to)) return false;
  const Vec3 normal = (t.b - t.a).cross(t.c - t.a), along = to - from;
  if (!(normal.dot(from - t.a) * normal.dot(to - t.a) < 0.0)) return false;
  const double u = along.dot((t.b - from).cross(t.c - from)), v = along.dot((t.c - from).cross(t.a - from)),
               w = along.dot((t.a - from).cross(t.b - from));
  return (u > 0.0 && v > 0.0 && w > 0.0) || (u < 0.0 && v < 0.0 && w < 0.0);
}

bool has_edge_through(const Corners& s, const Corners& t) {
  return passes_through(s.a, s.b, t) || passes_through(s.b, s.c, t) || passes_through(s.c, s.a, t);
}

bool overlap(const Box& a, const Box& b) {
  return (a.low.array() <= b.high.array()).all() && (b.low.array() <= a.high.array()).all();
}

int longest_axis(std::span<const Box> boxes) {
  Box all;
  int axis = 0;
  for (const Box& b : boxes)
    if (!b.empty()) all.extend(b.low), all.extend(b.high);
  all.size().maxCoeff(&axis);
  return axis;
}

}  // namespace

std::vector<std::array<std::size_t, 2>> find_crossings(std::span<const Vec3> positions,
                                                       std::span<const Triangle> triangles) {
  std::vector<Corners> corners;
  std::vector<Box> boxes;
  std::vector<std::size_t> order;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto& [a, b, c] = triangles[t];
    corners.push_back({positions[a], positions[b], positions[c]});
    Box& box = boxes.emplace_back();
    if (!(positions[a] + positions[b] + positions[c]).allFinite()) continue;
    for (const Index i : triangles[t]) box.extend(positions[i]);
    order.push_back(t);
  }
  const int axis = longest_axis(boxes);
  std::ranges::stable_sort(order, {}, [&](std::size_t t) { return boxes[t].low[axis]; });
  std::vector<std::array<std::size_t, 2>> found;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const std::size_t s = order[i];
    for (std::size_t j = i + 1; j < order.size(); ++j) {
      const std::size_t t = order[j];
      if (boxes[t].low[axis] > boxes[s].high[axis]) break;
      if (!overlap(boxes[s], boxes[t])) continue;
      if (has_edge_through(corners[s], corners[t]) || has_edge_through(corners[t], corners[s]))
        found.push_back({std::min(s, t), std::max(s, t)});
    }
  }
  std::ranges::sort(found);
  return found;
}

}  // namespace bodice::geometry
