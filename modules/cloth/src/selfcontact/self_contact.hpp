// Contact of the cloth with itself: particles with triangles, and edges with edges. What does not cross when
// a substep begins does not cross when it ends: pairs that may touch are known ahead of the motion
// (pairs.hpp), pushed apart to their gap (contacts.hpp), and held back where they would cross after all
// (zones.hpp). Where the body leaves no room, cloth comes nearer to it than its thickness
// (contact/sunk_particles.hpp). Where that does not help, layers cross until there is room (loose.hpp).
// What crosses when the simulation begins is drawn apart (tangles.hpp).
// Based on: Anka He Chen, Jerry Hsu, Ziheng Liu, Miles Macklin, Yin Yang, Cem Yuksel. Offset Geometric
// Contact. 2025. - section 4 (a bound on displacements keeps what is free of crossings so, without continuous
// tests)
// Differs: the bound is on how far a particle leaves the straight path that is expected of it, so that cloth
// that moves with a body is searched no more often than cloth at rest; past the bound, pairs are found anew.
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

/// The state of self-contact.
struct SelfContact {
  float gap_m = 0.0f;    ///< distance that layers keep, unless they were closer at rest
  float slack_m = 0.0f;  ///< how far leaves may move against each other until their pairs are found anew
  float spare_m = 0.0f;  ///< how much nearer than expected leaves may come until groups are found anew
  ContactMesh mesh;
  SweepTree tree;
  std::vector<PairTask> tasks;
  std::vector<Tangle> tangles;      ///< triangles that cross
  Loose loose;                      ///< corners of these, which contact leaves alone
  std::vector<Point> rest;          ///< #P: positions at rest, meters, in the particles' first frame
  std::vector<Point> before, now;   ///< #P: positions when the substep began, and at its end
  MovedLeaves moved_leaves;         ///< those with particles that moved since crossings were counted
  std::vector<Index> moved;         ///< particles that were moved after contact with the body
  std::vector<Point> found, ahead;  ///< #P: positions at the last search, and displacements expected then
  std::vector<float> beyond_m;      ///< #P: how far from there a particle may be beyond what all are allowed
  StrayedLeaves strayed;
  std::vector<Point> drift;          ///< #P: smoothed velocities, meters a second
  std::vector<LeafMove> moves;       ///< #leaves
  std::vector<float> off2;           ///< #P: squares of how far particles are off their expected paths
  std::vector<float> off_m;          ///< #leaves: the largest of its particles
  std::vector<std::uint8_t> folded;  ///< as PairSearch::folded, when the substep began
  Zones zones;
  float ahead_s = 0.0f, since_s = 0.0f;  ///< the time of these displacements; that since the search
  Vec3 origin = Vec3::Zero();            ///< that of the particles' frame at the last search
  bool searched = false;                 ///< whether there was a search that may still hold
  bool swept = false;                    ///< whether the tree has the sweeps of that search
  bool sided = false;                    ///< whether it is known what crosses
  int failed_yields = 0;                 ///< substeps of this frame in which layers crossed all the same
  SelfContactReport report;              ///< of this frame
};

/// The state for a welded garment at rest.
SelfContact make_self_contact(const geometry::TriMesh& mesh, const Particles& particles, double gap_m,
                              double median_edge_m);

/// Forgets all pairs, so that they are found anew.
void forget_pairs(SelfContact& self);

/// Begins a frame. Pairs are found anew where the particles' local frame has changed.
void begin_self_contact(const engine::Context& context, const Particles& particles, SelfContact& self);

/// What a substep does with layers that touch.
struct SelfSubstep {
  float length_s = 0.0f, frame_s = 0.0f;
  float friction = 0.0f;
  bool still_body = false;                 ///< whether the body stands in this frame
  std::span<const std::uint8_t> touching;  ///< #P: whether the body pushed the particle in the substep before
};

/// Pushes layers apart after constraints moved the points of the particles. The same bits for any number of
/// workers; allocates nothing once warm.
void push_apart(const engine::Context& context, const SelfSubstep& substep, SelfContact& self,
                Particles& particles);

/// What happened since the frame began.
SelfContactReport report_self_contact(const SelfContact& self);

/// Ends a substep: holds back what would cross on its path from where it began to the particles' positions.
/// Particles that would lie deeper in `body` for that stay, and layers cross there.
void hold_apart(const engine::Context& context, const SelfSubstep& substep, const ResolvedBody& body,
                SelfContact& self, Particles& particles);

}  // namespace bodice::cloth
