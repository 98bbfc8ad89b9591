// A bounding volume hierarchy over the leaves of a garment. Its boxes also bound how their contents move.
// What moves alike stays as far apart as it was, however fast, so that few parts of a walking body's garment
// come near each other.
// Based on: Christer Ericson. Real-Time Collision Detection. 2005. - sections 5.5.8 (moving boxes),
// 6.3 (hierarchies)
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <bodice/engine/context.hpp>

#include "pairs/contact_mesh.hpp"

namespace bodice::inline v0_1::cloth {

/// A box of points, and the box of their paths, which are straight.
struct Sweep {
  Float4 low, high;            ///< positions at first, meters; the fourth lane is zero
  Float4 move_low, move_high;  ///< displacements, meters
};

/// The hierarchy: node 1 is the root, and the children of node k are 2k and 2k + 1.
struct SweepTree {
  std::size_t leaves = 0;   ///< how many the garment has; the tree's others are empty
  std::size_t width = 1;    ///< leaves of the whole tree, a power of two; leaf k is node width + k
  std::vector<Sweep> node;  ///< #nodes
};

/// A hierarchy without boxes for these leaves.
SweepTree make_sweep_tree(const ContactMesh& mesh);

/// Particles on their paths; arrays of #P.
struct SweptPoints {
  std::span<const Point> at;      ///< where the paths begin
  std::span<const Point> move;    ///< their displacements; empty: all stay
  std::span<const float> room_m;  ///< how far around its path each may be; empty: nowhere but on it
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

/// Whether anything of a and b comes nearer than `reach_m` along all axes on its path, in doubt true.
inline bool may_be_near(const Sweep& a, const Sweep& b, Float4 reach_m) {
  const Float4 none = splat(0.0f);
  const Float4 over = a.low - b.high + min(none, a.move_low - b.move_high);
  const Float4 under = b.low - a.high + min(none, b.move_low - a.move_high);
  return !any((over > reach_m) | (under > reach_m));
}

/// How far apart the boxes are at first, meters.
inline float distance(const Sweep& a, const Sweep& b) {
  const Float4 apart = max(splat(0.0f), max(a.low - b.high, b.low - a.high));
  return __builtin_sqrtf(apart[0] * apart[0] + apart[1] * apart[1] + apart[2] * apart[2]);
}

/// Calls visit(leaf) for all leaves from `first` on that may be near a sweep, in order.
template <class Visit>
void for_each_near_leaf(const SweepTree& tree, const Sweep& own, std::size_t first, float reach_m,
                        Visit&& visit) {
  constexpr std::size_t kDeepest = 64;
  const Float4 reach = splat(reach_m);
  std::size_t stack[kDeepest] = {1};
  for (std::size_t size = 1; size > 0;) {
    const std::size_t node = stack[--size];
    if (!may_be_near(own, tree.node[node], reach)) continue;
    if (node >= tree.width) {
      // A position that is not a number is near everything, an empty leaf included.
      const std::size_t leaf = node - tree.width;
      if (leaf >= first && leaf < tree.leaves) visit(leaf);
      continue;
    }
    stack[size++] = 2 * node + 1;
    stack[size++] = 2 * node;
  }
}

/// Leaves that are handled together: few, so that their common box is small.
inline constexpr std::size_t kLeavesTogether = 8;

/// Calls visit(leaf, other) for all leaves of [first, last), at most kLeavesTogether, and all others from
/// their own on that may be near them, in order of leaf and other. Uses `room` for lists.
template <class Visit>
void for_each_near_leaf(const SweepTree& tree, std::size_t first, std::size_t last, float reach_m,
                        std::vector<std::uint32_t>& room, Visit&& visit) {
  room.clear();
  Sweep all = tree.node[tree.width + first];
  for (std::size_t leaf = first + 1; leaf < last; ++leaf) add(tree.node[tree.width + leaf], all);
  for_each_near_leaf(tree, all, first, reach_m,
                     [&](std::size_t leaf) { room.push_back(static_cast<std::uint32_t>(leaf)); });
  for (std::size_t leaf = first; leaf < last; ++leaf) {
    const Sweep& own = tree.node[tree.width + leaf];
    for (const std::uint32_t other : room)
      if (other >= leaf && may_be_near(own, tree.node[tree.width + other], splat(reach_m)))
        visit(leaf, other);
  }
}

}  // namespace bodice::cloth
