// Impact zones: the last resort for pairs that would cross in a substep. All particles of such pairs move
// together by the mean of their displacements, so that their distances do not change.
// Based on: David Harmon, Etienne Vouga, Rasmus Tamstorf, Eitan Grinspun. Robust Treatment of Simultaneous
// Collisions. 2008. - section 1 (rigid impact zones; Xavier Provot. 1997)
// Differs: zones move straight, because a turn within a substep is small. Pairs are tested by planes first.
#pragma once

#include <span>
#include <vector>

#include "base/particles.hpp"
#include "contact/sunk_particles.hpp"
#include "selfcontact/contacts.hpp"
#include "selfcontact/moved_leaves.hpp"

namespace bodice::inline v0_1::cloth {

/// The zones of a substep.
struct Zones {
  std::vector<Index> parent;   ///< #P: union-find over zones; kNoIndex for a particle of no zone
  std::vector<Index> members;  ///< the particles of all zones
  std::vector<Float4> moved;  ///< #P: at a zone's root: sums of mass times displacement and of mass, then the
                              ///< zone's displacement
  std::vector<Point> wanted;  ///< for each of `members`: its displacement before it joined a zone
  std::vector<Point> resolved;  ///< #P: positions to which contact with the body moved the particles
  std::vector<Guard> guard;     ///< #P: guards that keep particles from sinking into the body from `resolved`
};

/// The state for this number of particles, without zones.
Zones make_zones(std::size_t particles);

/// The condition under which a pair may cross. With ample room it may only if none of its particles can be
/// moved. With scarce room it may also if the body or pins press its parts together from both sides, or if it
/// lies within one zone. A zone crosses itself only where guarded particles cannot move with it.
enum class Room : std::uint8_t { kAmple, kScarce };

/// The parameters of a search for pairs that would cross.
struct CrossingSearch {
  std::span<const Point> now;    ///< #P: where paths end; a particle without weight cannot be moved
  std::span<const Guard> guard;  ///< #P: as Zones::guard
  std::span<const Index> zone;   ///< #P: as Zones::parent
  Room room = Room::kAmple;
};

/// Lists in each task the pairs that would cross on their paths: those that may cross in `pressed`, all
/// others in `crossing`. Returns the number of pairs in `crossing`.
std::size_t find_crossing(const engine::Context& context, const ContactSource& source,
                          const CrossingSearch& how, std::vector<PairTask>& tasks);

/// The same for the pairs of moved leaves alone. Pairs that may cross are added to those found before. Cost:
/// O(groups in the tasks with moved leaves).
std::size_t find_crossing_again(const engine::Context& context, const ContactSource& source,
                                const CrossingSearch& how, MovedLeaves& moved, std::vector<PairTask>& tasks);

/// Drops from `pressed` the pairs that do not cross on their paths to `now`, because they were moved since
/// they were found.
void drop_separated(const engine::Context& context, const ContactSource& source, std::span<const Point> now,
                    std::vector<PairTask>& tasks);

/// Joins the particles of each pair that would cross into one zone, and moves all zones: writes their
/// members' positions to `now`. Pins stay where they are, and a zone with pins moves as they do.
void join_zones(const std::vector<PairTask>& tasks, const Particles& particles, std::span<const Point> before,
                std::span<Point> now, Zones& zones);

/// Joins all particles into one zone, and moves the whole garment by its mean displacement.
void join_all(const Particles& particles, std::span<const Point> before, std::span<Point> now, Zones& zones);

/// Forgets all zones.
void clear_zones(Zones& zones);

}  // namespace bodice::cloth
