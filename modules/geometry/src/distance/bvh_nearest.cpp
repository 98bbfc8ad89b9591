#include "distance/bvh_nearest.hpp"

#include <algorithm>
#include <array>
#include <bit>

namespace bodice::inline v0_1::geometry {
namespace {

struct Pending {
  float distance2;
  std::uint32_t child;
};

// A squared distance above the clamped one of every box, and below that of a missing child, which is
// infinite.
constexpr float kKeepAll = 3e38f;

/// A query, exact and in floats. Distances of the latter to boxes and triangles, less the slack, never exceed
/// the true ones.
struct FloatQuery {
  Vec3 exact;
  std::array<float, 3> p;
  double slack;  // local units: what rounding the query and the arithmetic may add to a distance

  explicit FloatQuery(const Vec3& q)
      : exact(q),
        p{clamped(q[0]), clamped(q[1]), clamped(q[2])},
        slack(LeafTriangles::kSlack * (q.cwiseAbs().maxCoeff() + 1.0)) {}

  /// Bounds coordinates so that squares stay finite. At such distances the slack keeps every box.
  static float clamped(double x) { return static_cast<float>(std::clamp(x, -1e18, 1e18)); }

  /// The squared distance beyond which no box or triangle holds a point nearer than sqrt(best2).
  float reach2(double best2) const {
    const double reach = std::sqrt(best2) + slack;
    const double reach2 = reach * reach * (1.0 + 1e-6);
    return reach2 < static_cast<double>(kKeepAll) ? static_cast<float>(reach2) : kKeepAll;
  }

  Float4 box_distances2(const BvhNode& node) const {
    Float4 sum{};
    for (int k = 0; k < 3; ++k) {
      const Float4 gap = max(Float4{}, max(p[k] - node.high[k], node.low[k] - p[k]));
      sum += gap * gap;
    }
    return sum;
  }
};

/// Tests the triangles of a leaf exactly if floats cannot rule them out, and returns whether one is nearer
/// than `best`. Most are ruled out, four at a time and without branches.
template <class Counts>
bool visit_leaf(const Bvh& bvh, const LeafTriangles& leaf, const FloatQuery& q, float reach2,
                const Counts& counts, BvhHit& best) {
  bool nearer = false;
  unsigned near = lane_bits(leaf.distances2(q.p) <= reach2) & ((1u << leaf.count) - 1);
  for (; near != 0; near &= near - 1) {
    const std::uint32_t i = leaf.first + static_cast<std::uint32_t>(std::countr_zero(near));
    const BvhTriangle& t = bvh.triangles[i];
    const TrianglePoint at = closest_point(t.a, t.a + t.ab, t.a + t.ac, q.exact);
    const double distance2 = (at.point - q.exact).squaredNorm();
    if (!(distance2 < best.distance2) || !counts(bvh.triangle_of_leaf[i])) continue;
    best = {distance2, i, at};
    nearer = true;
  }
  return nearer;
}

template <class Counts>
BvhHit nearest(const Bvh& bvh, const Vec3& query, double limit2, const Counts& counts) {
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
      if (visit_leaf(bvh, bvh.leaf(top.child), q, reach2, counts, best)) reach2 = q.reach2(best.distance2);
      continue;
    }
    const BvhNode& node = bvh.nodes[top.child];
    const Float4 distance2 = q.box_distances2(node);
    const int base = depth;
    for (unsigned near = lane_bits(distance2 <= reach2); near != 0; near &= near - 1) {
      const int i = std::countr_zero(near);
      int at = depth++;  // insertion sort: the nearest child ends on top
      for (; at > base && stack[at - 1].distance2 < distance2[i]; --at) stack[at] = stack[at - 1];
      stack[at] = {distance2[i], node.child[i]};
    }
  }
  return best;
}

}  // namespace

BvhHit nearest_triangle(const Bvh& bvh, const Vec3& query, double limit2) {
  return nearest(bvh, query, limit2, [](Index) { return true; });
}

BvhHit nearest_triangle(const Bvh& bvh, const Vec3& query, double limit2,
                        engine::FunctionRef<bool(Index)> counts) {
  return nearest(bvh, query, limit2, counts);
}

}  // namespace bodice::geometry
