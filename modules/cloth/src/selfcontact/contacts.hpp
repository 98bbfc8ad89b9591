// Contacts of the pairs that come near in a substep, and their push. Normals are those of the substep's
// start, so that parts that would pass through each other are pushed back to the side they came from.
// Based on: Miles Macklin, Matthias Mueller, Nuttapong Chentanez. XPBD: Position-Based Simulation of
// Compliant Constrained Dynamics. 2016. - section 3; Robert Bridson, Ronald Fedkiw, John Anderson. Robust
// Treatment of Collisions, Contact and Friction for Cloth Animation. 2002. - section 7 (repulsion, friction)
// Differs: no compliance. Pairs are looked at again only when their leaves have moved against each other.
#pragma once

#include <vector>

#include <bodice/engine/context.hpp>

#include "contact/sunk_particles.hpp"
#include "pairs/pairs.hpp"

namespace bodice::inline v0_1::cloth {

/// The box of a leaf's particles when a substep begins, and that of their displacements in it, meters.
struct LeafMove {
  Float4 at_low, at_high;
  Float4 low, high;
};

/// How far a part of one leaf moves against one of another, at most, meters.
inline float relative_move(const LeafMove& a, const LeafMove& b) {
  const Float4 most = max(a.high - b.low, b.high - a.low);
  return __builtin_sqrtf(dot(most, most));
}

/// What contacts of a substep are made from.
struct ContactSource {
  const ContactMesh& mesh;
  PairSearch search;                    ///< at the positions when the substep began
  std::span<const Point> rest;          ///< #P: positions at rest
  std::span<const LeafMove> moves;      ///< #leaves: in this substep
  std::span<const float> off_m;         ///< #leaves: how far they are off their expected paths at its end
  std::span<const std::uint8_t> loose;  ///< #P: pairs with two parts of which any is loose have no contact

  float step_of(const PairGroup& group) const {
    return relative_move(moves[group.leaf[0]], moves[group.leaf[1]]);
  }
};

/// The displacements of a leaf from `before` to `now`.
LeafMove move_of(const ContactMesh& mesh, std::size_t leaf, std::span<const Point> before,
                 std::span<const Point> now);

/// The contact of a pair when the substep began; sets its gap, if that is not known yet. Its distance is zero
/// where the two touch, so that there is no normal.
PairContact contact_of(const ContactSource& source, Pair& pair);

/// Finds the pairs of a group anew, if leaves that move by `step_m` against each other need others.
void keep_pairs(const ContactSource& source, float step_m, PairGroup& group, PairTask& task);

/// Lists the contacts of all pairs that may come too near in this substep, before it moves anything.
void refresh_contacts(const engine::Context& context, const ContactSource& source,
                      std::vector<PairTask>& tasks);

/// How contacts push.
struct PairPush {
  float friction = 0.0f;
  float recovery_m = 0.0f;                 ///< how far parts that are too near move apart in a substep
  std::span<const Point> before;           ///< #P
  std::span<const std::uint8_t> touching;  ///< #P: whether the particle lies on the body
  /// #P, or empty: what keeps particles from sinking into the body (contact/sunk_particles.hpp).
  std::span<const Point> resolved;
  std::span<const Guard> guard;
};

/// Pushes the parts of all contacts apart: those inside blocks in parallel, because blocks share no particle,
/// then those across. The same for any number of workers.
void push_contacts(const engine::Context& context, const ContactMesh& mesh, const PairPush& how,
                   const std::vector<PairTask>& tasks, std::span<Point> at);

/// Pushes the parts of the tasks' held pairs apart, once, one after the other; returns whether any was too
/// near.
bool push_held(const PairPush& how, const std::vector<PairTask>& tasks, std::span<Point> at);

}  // namespace bodice::cloth
