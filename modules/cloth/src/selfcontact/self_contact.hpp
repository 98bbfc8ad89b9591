// Contact of the cloth with itself: particles with triangles, and edges with edges. Parts that do not cross
// when a substep begins do not cross when it ends. Pairs that may touch are listed before they move
// (pairs.hpp) and pushed apart to their gap (contacts.hpp). Where they would still cross, their particles
// move together (zones.hpp). Where the body leaves no room, cloth comes nearer to it than its thickness
// (contact/sunk_particles.hpp). Where that does not help, layers cross until there is room (loose.hpp).
// Triangles that cross are drawn apart (tangles.hpp).
// Based on: Anka He Chen, Jerry Hsu, Ziheng Liu, Miles Macklin, Yin Yang, Cem Yuksel. Offset Geometric
// Contact. 2025. - section 4 (a bound on displacements keeps what is free of crossings so, without continuous
// tests)
// Differs: the bound is on a particle's deviation from an expected straight path, so that cloth that moves
// with a body needs no more searches than cloth at rest. Beyond the bound, pairs are found anew.
#pragma once

#include <vector>

#include <bodice/cloth/solver.hpp>
#include <bodice/engine/context.hpp>

#include "contact/sunk_particles.hpp"
#include "selfcontact/contacts.hpp"
#include "selfcontact/loose.hpp"
#include "selfcontact/moved_leaves.hpp"
#include "selfcontact/strayed_leaves.hpp"
#include "selfcontact/zones.hpp"

namespace bodice::inline v0_1::cloth {

/// The straight paths that a search expects of particles, and how far particles have left them.
struct ExpectedPaths {
  std::vector<Point> start, move;  ///< #P: positions at the search, and the displacements over `duration_s`
  float duration_s = 0.0f;
  float since_s = 0.0f;            ///< time since the search
  std::vector<float> allowance_m;  ///< #P: the deviation that a particle may have beyond that of all others
  std::vector<float> deviation2;   ///< #P: squared deviations, square meters
  std::vector<Point> pulled;       ///< #P: the part of a pull by constraints that the body will undo, meters
  std::vector<Point> drift;  ///< #P: smoothed velocities, which the next search expects, meters a second
};

/// The state of self-contact.
struct SelfContact {
  float gap_m = 0.0f;    ///< distance that layers keep, unless they were closer at rest
  float slack_m = 0.0f;  ///< how far leaves may move against each other before their pairs are found anew
  float spare_m = 0.0f;  ///< how much nearer than expected leaves may come before groups are listed anew
  ContactMesh mesh;
  SweepTree tree;
  std::vector<PairTask> tasks;
  std::vector<Tangle> tangles;     ///< triangles that cross
  Loose loose;                     ///< the pairs around these on which contact does not act
  std::vector<Point> rest;         ///< #P: positions at rest, meters, in the local frame of that time
  std::vector<Point> before, now;  ///< #P: positions when the substep began, and at its end
  MovedLeaves moved_leaves;        ///< leaves with particles that moved since crossings were last counted
  std::vector<Index> moved;        ///< particles that were moved after contact with the body
  ExpectedPaths paths;             ///< the paths that the last search expects
  StrayedLeaves strayed;
  std::vector<LeafMove> moves;       ///< #leaves
  std::vector<float> deviation_m;    ///< #leaves: the largest deviation of its particles
  std::vector<std::uint8_t> folded;  ///< as PairSearch::folded, when the substep began
  Zones zones;
  Vec3 origin = Vec3::Zero();    ///< origin of the particles' local frame at the last search
  bool searched = false;         ///< whether the lists of the last search may still be used
  bool tree_has_sweeps = false;  ///< whether the tree still has the sweeps of that search
  bool crossings_known = false;  ///< whether `tangles` has all triangles that cross
  /// Number of substeps in this frame in which layers crossed although cloth came nearer to the body.
  int failed_yields = 0;
  SelfContactReport report;  ///< what happened in this frame
};

/// The state for a welded garment at rest.
SelfContact make_self_contact(const geometry::TriMesh& mesh, const Particles& particles, double gap_m,
                              double median_edge_m);

/// Removes all pairs, so that the next substep searches for them anew.
void forget_pairs(SelfContact& self);

/// Begins a frame. Pairs are found anew where the particles' local frame has changed.
void begin_self_contact(const engine::Context& context, const Particles& particles, SelfContact& self);

/// The parameters of self-contact in a substep.
struct SelfSubstep {
  float length_s = 0.0f, frame_s = 0.0f;
  float friction = 0.0f;
  bool still_body = false;                 ///< whether the body stands still in this frame
  std::span<const std::uint8_t> touching;  ///< #P: whether the body pushed the particle in the substep before
  /// #P: below 1 where an edge of the particle is stretched far beyond the limit of its fabric
  /// (ContactState::friction_share). Empty where none is, or where the body stands still.
  std::span<const float> friction_share = {};
};

/// Pushes layers apart after constraints moved the points of the particles. The same bits for any number of
/// workers; allocates nothing once warm.
void push_apart(const engine::Context& context, const SelfSubstep& substep, SelfContact& self,
                Particles& particles);

/// The report of self-contact since the frame began.
SelfContactReport report_self_contact(const SelfContact& self);

/// Ends a substep: moves particles so that none of their paths in the substep cross, if that is possible. No
/// particle is moved deeper into `body` for that; where only such a move would help, layers cross.
void hold_apart(const engine::Context& context, const SelfSubstep& substep, const ResolvedBody& body,
                SelfContact& self, Particles& particles);

}  // namespace bodice::cloth
