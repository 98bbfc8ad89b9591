// Impact zones: the last resort for parts that would cross in a substep. All particles of such pairs move
// together instead, by the mean of their displacements, so that nothing among them comes nearer.
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
  std::vector<Index> parent;    ///< #P: union-find; a particle of no zone is its own parent
  std::vector<Index> members;   ///< the particles of all zones
  std::vector<Float4> moved;    ///< #P: at a zone's root: mass times displacement, and mass
  std::vector<Point> wanted;    ///< as members: their displacements before they joined a zone
  std::vector<Point> resolved;  ///< #P: positions where contact with the body was resolved
  std::vector<Guard> guard;     ///< #P: what keeps particles from sinking from there
};

Zones make_zones(std::size_t particles);

/// The condition under which pairs may cross. With ample room, they may only if none of their particles can
/// be moved. With scarce room, they may also if the body or pins press their parts together from both sides.
/// So may pairs within one zone then, because a zone crosses itself only where guarded particles cannot move
/// with it.
enum class Room : std::uint8_t { kAmple, kScarce };

/// The particles among which pairs that would cross are searched for.
struct CrossingSearch {
  std::span<const Point> now;    ///< #P: where paths end; a particle without weight cannot be moved
  std::span<const Guard> guard;  ///< #P: as Zones::guard
  std::span<const Index> zone;   ///< #P: as Zones::parent
  Room room = Room::kAmple;
};

/// Lists the pairs that would cross on their paths, by task, and apart from them those that may; returns the
/// number of the former.
std::size_t find_crossing(const engine::Context& context, const ContactSource& source,
                          const CrossingSearch& how, std::vector<PairTask>& tasks);

/// Lists the pairs of moved leaves that would cross, and returns their number. Pairs that may cross are added
/// to those found before. It costs as much as all groups in tasks with such leaves.
std::size_t find_crossing_again(const engine::Context& context, const ContactSource& source,
                                const CrossingSearch& how, MovedLeaves& moved, std::vector<PairTask>& tasks);

/// Joins the particles of the pairs that would cross, and moves all zones: writes their members' positions to
/// `now`. Pins stay where they are; a zone with some moves as these do.
void join_zones(const std::vector<PairTask>& tasks, const Particles& particles, std::span<const Point> before,
                std::span<Point> now, Zones& zones);

/// Moves the whole garment by its mean displacement.
void join_all(const Particles& particles, std::span<const Point> before, std::span<Point> now, Zones& zones);

/// Forgets all zones.
void clear_zones(Zones& zones);

}  // namespace bodice::cloth
