// A bounding volume hierarchy over the leaves of a garment. Its boxes also bound how their contents move.
// Leaves that move alike stay as far apart as they were, however fast they are. So few parts of a walking
// body's garment count as near each other.
// Based on: Christer Ericson. Real-Time Collision Detection. 2005. - sections 5.5.8 (moving boxes),
// 6.3 (hierarchies); Holger Dammertz, Johannes Hanika, Alexander Keller. Shallow Bounding Volume Hierarchies
// for Fast SIMD Ray Tracing of Incoherent Rays. 2008. (four children are tested at once)
#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include <bodice/engine/context.hpp>

#include "pairs/contact_mesh.hpp"

namespace bodice::inline v0_1::cloth {

/// A box of points, and a box of their displacements along straight paths.
struct Sweep {
  Float4 low, high;            ///< positions at first, meters; the fourth lane is zero
  Float4 move_low, move_high;  ///< displacements, meters
};

/// Four sweeps by axis: lane k of each vector belongs to sweep k.
struct SweepQuad {
  Float4 low[3], high[3], move_low[3], move_high[3];
};

/// The hierarchy. Quad 0 is the root, and lane k of quad q bounds quad 4 q + 1 + k, or holds a leaf.
struct SweepTree {
  std::size_t first_leaf_quad = 0;  ///< quads from this one on hold leaves
  std::size_t leaves_a_lane = 1;    ///< how many leaves a lane of the root bounds
  std::vector<Sweep> leaf;          ///< #leaves of the garment; lanes beyond these are empty
  std::vector<SweepQuad> quad;      ///< #quads
};

/// A hierarchy without boxes for these leaves.
SweepTree make_sweep_tree(const ContactMesh& mesh);

/// Particles on their paths; arrays of #P.
struct SweptPoints {
  std::span<const Point> at;      ///< where the paths begin
  std::span<const Point> move;    ///< their displacements; empty: no particle moves
  std::span<const float> room_m;  ///< #P: how far each may be from its path; empty: 0
};

/// The sweep of a leaf's particles.
Sweep sweep_of(const ContactMesh& mesh, std::size_t leaf, const SweptPoints& points);

/// Fits all boxes. O(#triangles).
void refit(const engine::Context& context, const ContactMesh& mesh, const SweptPoints& points,
           SweepTree& tree);

/// Fits the boxes of one leaf anew, and widens all that hold it. O(log #leaves).
void refit_leaf(const ContactMesh& mesh, std::size_t leaf, const SweptPoints& points, SweepTree& tree);

/// Widens a sweep by another one.
inline void add(const Sweep& more, Sweep& all) {
  all.low = min(all.low, more.low), all.high = max(all.high, more.high);
  all.move_low = min(all.move_low, more.move_low), all.move_high = max(all.move_high, more.move_high);
}

/// How far apart the boxes are at first, meters.
inline float distance(const Sweep& a, const Sweep& b) {
  const Float4 apart = max(splat(0.0f), max(a.low - b.high, b.low - a.high));
  return __builtin_sqrtf(dot(apart, apart));
}

/// Which of four sweeps may come near another one, and how near.
struct NearLanes {
  unsigned near = 0;  ///< bit k: sweep k may come nearer than the reach along all axes
  Float4 apart2;      ///< lower bounds of their squared distances on their paths, square meters
};

/// A sweep that is tested against four at once.
class QuadTest {
 public:
  explicit QuadTest(const Sweep& own) {
    for (int axis = 0; axis < 3; ++axis) {
      own_.low[axis] = splat(own.low[axis]), own_.high[axis] = splat(own.high[axis]);
      own_.move_low[axis] = splat(own.move_low[axis]), own_.move_high[axis] = splat(own.move_high[axis]);
    }
  }

  NearLanes operator()(const SweepQuad& quad, float reach_m) const {
    const Float4 none = splat(0.0f), reach = splat(reach_m);
    Int4 far = {};
    NearLanes lanes{.apart2 = none};
    for (int axis = 0; axis < 3; ++axis) {
      const Float4 over =
          own_.low[axis] - quad.high[axis] + min(none, own_.move_low[axis] - quad.move_high[axis]);
      const Float4 under =
          quad.low[axis] - own_.high[axis] + min(none, quad.move_low[axis] - own_.move_high[axis]);
      const Float4 apart = max(none, max(over, under));
      far |= (over > reach) | (under > reach);
      lanes.apart2 += apart * apart;
    }
    lanes.near = ~lane_bits(far) & 0xFu;
    return lanes;
  }

 private:
  SweepQuad own_;  // the sweep in all lanes
};

/// Calls visit(quad, near) for each quad of leaves that has a leaf near a sweep, in order. Quads with leaves
/// before `first` alone are left out. Bit k of `near` is set if lane k is near.
template <class Visit>
void for_each_near_quad(const SweepTree& tree, const Sweep& own, std::size_t first, float reach_m,
                        Visit&& visit) {
  struct Entry {
    std::size_t quad, first_leaf, leaves_a_lane;
  };
  constexpr std::size_t kDeepest = 64;
  const QuadTest test(own);
  Entry stack[kDeepest] = {{0, 0, tree.leaves_a_lane}};
  for (std::size_t size = 1; size > 0;) {
    const Entry entry = stack[--size];
    const unsigned near = test(tree.quad[entry.quad], reach_m).near;
    if (entry.quad >= tree.first_leaf_quad) {
      if (near != 0) visit(entry.quad, near);
      continue;
    }
    for (std::size_t lane = 4; lane-- > 0;) {
      const std::size_t first_leaf = entry.first_leaf + lane * entry.leaves_a_lane;
      if ((near >> lane & 1u) != 0 && first_leaf + entry.leaves_a_lane > first)
        stack[size++] = {4 * entry.quad + 1 + lane, first_leaf, entry.leaves_a_lane / 4};
    }
  }
}

/// Calls visit(leaf, lane) for each lane of a quad of leaves with its bit set. A position that is not a
/// number is near everything, lanes without a leaf included; these are left out, and those before `first`.
template <class Visit>
void for_each_leaf(const SweepTree& tree, std::size_t quad, unsigned near, std::size_t first, Visit&& visit) {
  for (; near != 0; near &= near - 1u) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(near));
    const std::size_t leaf = 4 * (quad - tree.first_leaf_quad) + lane;
    if (leaf >= first && leaf < tree.leaf.size()) visit(leaf, lane);
  }
}

/// Calls visit(leaf) for all leaves that may be near a sweep, in order.
template <class Visit>
void for_each_near_leaf(const SweepTree& tree, const Sweep& own, float reach_m, Visit&& visit) {
  for_each_near_quad(tree, own, 0, reach_m, [&](std::size_t quad, unsigned near) {
    for_each_leaf(tree, quad, near, 0, [&](std::size_t leaf, std::size_t) { visit(leaf); });
  });
}

/// Leaves that are handled together: few, so that their common box is small.
inline constexpr std::size_t kLeavesTogether = 8;

/// Calls visit(leaf, other, apart_m) for each leaf of [first, last), at most kLeavesTogether, and each leaf
/// from it on that may be near it, sorted by both. On their paths they are at least `apart_m` apart. `room`
/// is scratch.
template <class Visit>
void for_each_near_leaf(const SweepTree& tree, std::size_t first, std::size_t last, float reach_m,
                        std::vector<std::uint32_t>& room, Visit&& visit) {
  room.clear();
  Sweep all = tree.leaf[first];
  for (std::size_t leaf = first + 1; leaf < last; ++leaf) add(tree.leaf[leaf], all);
  for_each_near_quad(tree, all, first, reach_m,
                     [&](std::size_t quad, unsigned) { room.push_back(static_cast<std::uint32_t>(quad)); });
  for (std::size_t leaf = first; leaf < last; ++leaf) {
    const QuadTest test(tree.leaf[leaf]);
    for (const std::uint32_t quad : room) {
      const NearLanes lanes = test(tree.quad[quad], reach_m);
      for_each_leaf(tree, quad, lanes.near, leaf, [&](std::size_t other, std::size_t lane) {
        visit(leaf, other, __builtin_sqrtf(lanes.apart2[lane]));
      });
    }
  }
}

}  // namespace bodice::cloth
