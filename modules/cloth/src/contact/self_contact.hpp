// Layers of one garment keep apart: particles repel each other. Not covered: edges and faces between
// particles, and layers that already passed through each other (the side is not remembered).
#pragma once

#include <limits>
#include <vector>

#include <bodice/engine/context.hpp>

#include "base/particles.hpp"
#include "contact/cell_grid.hpp"
#include "garment/topology.hpp"

namespace bodice::cloth {

inline constexpr std::size_t kMaxClose = 8;  ///< pairs kept a particle; the first in the grid's order

/// The first particles that edges join to one, itself last; itself where there are fewer.
struct Joined {
  static constexpr std::size_t kFirst = 8;  ///< as most vertices of a mesh have at most
  Int4 id[kFirst / 4];
};

/// The particles near one, four to a load; a line of the cache holds them all.
struct alignas(64) ClosePairs {
  struct Four {
    Index with[4] = {};    ///< places that are not taken name a particle, too
    float keep_m[4] = {};  ///< distance that each pair must keep
  };
  Four four[kMaxClose / 4];
};

struct SelfContact {
  float radius_m = 0.0f;  ///< particles are kept this far apart, or as far as they were at rest
  double travel_m = std::numeric_limits<double>::infinity();  ///< of the fastest since the pairs were found
  CellGrid grid;
  std::vector<Point> rest;                ///< #P, meters, in the particles' frame of the start
  std::vector<Joined> joined;             ///< #P
  std::vector<ClosePairs> close;          ///< #P
  std::vector<std::uint8_t> close_count;  ///< #P
  std::vector<Index> active;              ///< #P, from each block's first on: its particles with pairs
  std::vector<Index> active_count;        ///< #blocks
  std::vector<Point> move;                ///< as active: meters, corrections of this sweep
};

SelfContact make_self_contact(const Particles& particles, const Ring& ring, double radius_m);

/// Finds the pairs nearer than 1.8 times the radius, unless none of the last search can have been missed: two
/// particles that each moved 0.4 radii since are still a radius apart. O(#P).
void find_close_pairs(const engine::Context& context, const Ring& ring, const Particles& particles,
                      SelfContact& self);

/// One Jacobi sweep: each particle sums its pairs' corrections from the same positions, so that neither order
/// nor workers matter; with Coulomb friction. `touching`: who lies on the body, #P.
void push_apart(const engine::Context& context, const std::vector<std::uint8_t>& touching, float friction,
                float substep_s, SelfContact& self, Particles& particles);

}  // namespace bodice::cloth
