// Self-contact: particles of different layers repel each other. Edges and faces between particles are not
// covered, nor are layers that passed through each other, because sides are not stored.
#pragma once

#include <limits>
#include <vector>

#include <bodice/engine/context.hpp>

#include "base/particles.hpp"
#include "contact/cell_grid.hpp"
#include "garment/topology.hpp"

namespace bodice::cloth {

inline constexpr std::size_t kMaxClose =
    8;  ///< the most pairs of a particle: the first ones in the grid's order

/// The first particles that edges join to a particle, which is the last entry itself and fills unused ones.
struct Joined {
  static constexpr std::size_t kFirst = 8;  ///< most vertices of a mesh have no more neighbors
  Int4 id[kFirst / 4];
};

/// The particles near a particle, in groups of four for a load; all fit into a cache line.
struct alignas(64) ClosePairs {
  struct Four {
    Index with[4] = {};    ///< unused entries have a valid index as well
    float keep_m[4] = {};  ///< distance that each pair must keep
  };
  Four four[kMaxClose / 4];
};

/// The state of self-contact.
struct SelfContact {
  float radius_m = 0.0f;  ///< distance that particles keep, unless they were closer at rest
  double travel_m =
      std::numeric_limits<double>::infinity();  ///< of the fastest particle since the last search
  CellGrid grid;
  std::vector<Point> rest;                ///< #P: positions at rest, meters, in the particles' first frame
  std::vector<Joined> joined;             ///< #P
  std::vector<ClosePairs> close;          ///< #P
  std::vector<std::uint8_t> close_count;  ///< #P
  std::vector<Index> active;              ///< #P: from the start of each block, its particles with pairs
  std::vector<Index> active_count;        ///< #blocks
  std::vector<Point> move;                ///< as active: corrections of this sweep, meters
};

/// The state for a garment at rest, with particles that keep `radius_m` apart.
SelfContact make_self_contact(const Particles& particles, const Ring& ring, double radius_m);

/// Finds the pairs closer than 1.8 times the radius, unless those of the last search suffice: two particles
/// that were farther apart and moved by up to 0.4 radii each are still a radius apart. O(#P).
void find_close_pairs(const engine::Context& context, const Ring& ring, const Particles& particles,
                      SelfContact& self);

/// Makes one Jacobi sweep with Coulomb friction. Each particle sums its pairs' corrections from the same
/// positions, so that neither their order nor the number of workers matters. `touching` is #P: whether the
/// particle lies on the body.
void push_apart(const engine::Context& context, const std::vector<std::uint8_t>& touching, float friction,
                float substep_s, SelfContact& self, Particles& particles);

}  // namespace bodice::cloth
