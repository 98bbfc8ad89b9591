#include "bvh_nearest.hpp"

#include <algorithm>
#include <array>

namespace bodice::geometry {
namespace {

struct Pending {
  float distance2;
  std::uint32_t child;
};

// Above the clamped distance of every box, below that of a missing child, which is infinite.
constexpr float kKeepAll = 3e38f;

/// A single-precision query whose box distances, with the slack, never exceed the true ones.
struct FloatQuery {
  std::array<float, 3> p;
  double slack;  // local units: what rounding the query and the arithmetic may add to a distance

  explicit FloatQuery(const Vec3& q)
      : p{clamped(q[0]), clamped(q[1]), clamped(q[2])},
        slack(8.0 * static_cast<double>(std::numeric_limits<float>::epsilon()) *
              (q.cwiseAbs().maxCoeff() + 1.0)) {}

  /// Keeps squares finite; so far away the slack keeps every box.
  static float clamped(double x) { return static_cast<float>(std::clamp(x, -1e18, 1e18)); }

  /// Boxes beyond this squared distance cannot hold anything nearer than sqrt(best2).
  float reach2(double best2) const {
    const double reach = std::sqrt(best2) + slack;
    const double reach2 = reach * reach * (1.0 + 1e-6);
    return reach2 < static_cast<double>(kKeepAll) ? static_cast<float>(reach2) : kKeepAll;
  }

  void box_distances2(const BvhNode& node, float* out) const {
    for (int i = 0; i < BvhNode::kWidth; ++i) out[i] = 0.0f;
    for (int k = 0; k < 3; ++k)
      for (int i = 0; i < BvhNode::kWidth; ++i) {
        const float below = node.low[k][i] - p[k];
        const float above = p[k] - node.high[k][i];
        const float gap = std::max(std::max(below, above), 0.0f);
        out[i] += gap * gap;
      }
  }
};

void visit_leaf(const Bvh& bvh, std::uint32_t child, const Vec3& query, BvhHit& best) {
  const std::uint32_t first = BvhChild::first(child);
  for (std::uint32_t i = first, end = first + BvhChild::count(child); i < end; ++i) {
    const BvhTriangle& t = bvh.triangles[i];
    const TrianglePoint at = closest_point(t.a, t.a + t.ab, t.a + t.ac, query);
    const double distance2 = (at.point - query).squaredNorm();
    if (distance2 < best.distance2) best = {distance2, i, at};
  }
}

}  // namespace

BvhHit nearest_triangle(const Bvh& bvh, const Vec3& query, double limit2) {
  BvhHit best;
  best.distance2 = limit2;
  if (bvh.nodes.empty() || !query.allFinite()) return best;
  const FloatQuery q(query);
  float reach2 = q.reach2(limit2);
  std::array<Pending, Bvh::kStackSize> stack;
  int depth = 0;
  stack[depth++] = {0.0f, 0};
  while (depth > 0) {
    const Pending top = stack[--depth];
    if (top.distance2 > reach2) continue;
    if (BvhChild::is_leaf(top.child)) {
      visit_leaf(bvh, top.child, query, best);
      reach2 = q.reach2(best.distance2);
      continue;
    }
    const BvhNode& node = bvh.nodes[top.child];
    float distance2[BvhNode::kWidth];
    q.box_distances2(node, distance2);
    const int base = depth;
    for (int i = 0; i < BvhNode::kWidth; ++i) {
      if (distance2[i] > reach2) continue;
      int at = depth++;  // insertion sort: the nearest child ends on top
      for (; at > base && stack[at - 1].distance2 < distance2[i]; --at) stack[at] = stack[at - 1];
      stack[at] = {distance2[i], node.child[i]};
    }
  }
  return best;
}

}  // namespace bodice::geometry
