// Contacts of the pairs that come near in a substep, and the pushes that separate them. Their normals are
// those at the start of the substep, so that parts that would pass through each other are pushed back.
// Based on: Miles Macklin, Matthias Mueller, Nuttapong Chentanez. XPBD: Position-Based Simulation of
// Compliant Constrained Dynamics. 2016. - section 3; Robert Bridson, Ronald Fedkiw, John Anderson. Robust
// Treatment of Collisions, Contact and Friction for Cloth Animation. 2002. - section 7 (repulsion, friction)
// Differs: no compliance. A pair is tested again only when its leaves have moved against each other.
#pragma once

#include <vector>

#include <bodice/engine/context.hpp>

#include "contact/sunk_particles.hpp"
#include "pairs/pairs.hpp"
#include "selfcontact/loose.hpp"

namespace bodice::inline v0_1::cloth {

/// The box of a leaf's particles when a substep begins, and that of their displacements in it, meters.
struct LeafMove {
  Float4 at_low, at_high;
  Float4 low, high;
};

/// An upper bound of how far a part of one leaf moves against a part of the other, meters.
inline float relative_move(const LeafMove& a, const LeafMove& b) {
  const Float4 most = max(a.high - b.low, b.high - a.low);
  return __builtin_sqrtf(dot(most, most));
}

/// The data from which the contacts of a substep are made.
struct ContactSource {
  const ContactMesh& mesh;
  PairSearch search;                ///< at the positions when the substep began
  std::span<const Point> rest;      ///< #P: positions at rest
  std::span<const LeafMove> moves;  ///< #leaves: in this substep
  /// #leaves: their deviations from the expected paths when the substep ends.
  std::span<const float> deviation_m;
  const Loose& loose;  ///< pairs that have no contact

  float step_of(const PairGroup& group) const {
    return relative_move(moves[group.leaf[0]], moves[group.leaf[1]]);
  }
};

/// The displacements of a leaf from `before` to `now`.
LeafMove move_of(const ContactMesh& mesh, std::size_t leaf, std::span<const Point> before,
                 std::span<const Point> now);

/// The contact of a pair when the substep began. Sets the pair's gap if that is unknown. Parts that touch
/// have a distance of zero and no normal.
PairContact contact_of(const ContactSource& source, Pair& pair);

/// Finds the pairs of a group anew if its list is not complete once its leaves move by `step_m` against each
/// other.
void update_pairs(const ContactSource& source, float step_m, PairGroup& group, PairTask& task);

/// Lists the contacts of all pairs that may come too near in this substep. Call it before particles are
/// pushed.
void refresh_contacts(const engine::Context& context, const ContactSource& source,
                      std::vector<PairTask>& tasks);

/// How contacts push.
struct PairPush {
  float friction = 0.0f;
  float recovery_m = 0.0f;                 ///< how far parts that are too near move apart in a substep
  std::span<const Point> before;           ///< #P
  std::span<const std::uint8_t> touching;  ///< #P: whether the particle lies on the body
  /// #P, or empty: positions and guards that keep particles out of the body (contact/sunk_particles.hpp).
  std::span<const Point> resolved;
  std::span<const Guard> guard;
};

/// Pushes the parts of all contacts apart. Contacts inside blocks are pushed in parallel, because blocks
/// share no particle, and contacts across blocks after them. The result is the same for any number of
/// workers.
void push_pairs_apart(const engine::Context& context, const ContactMesh& mesh, const PairPush& how,
                      const std::vector<PairTask>& tasks, std::span<Point> at);

/// Pushes apart, once and one after the other, the pairs that would cross (PairTask::held). Returns whether
/// any was too near.
bool push_crossing_pairs(const PairPush& how, const std::vector<PairTask>& tasks, std::span<Point> at);

}  // namespace bodice::cloth
