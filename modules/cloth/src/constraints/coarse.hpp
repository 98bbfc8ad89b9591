// Coarse levels against numerical stretch. With one sweep a substep a long piece would hang like rubber,
// because a pull travels only an edge or two a sweep. A coarse node represents the particles around it.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <bodice/engine/context.hpp>

#include "base/particles.hpp"
#include "base/schedule.hpp"
#include "garment/topology.hpp"

namespace bodice::inline v0_1::cloth {

inline constexpr std::size_t kParents = 4;     ///< nodes that move a particle
inline constexpr std::size_t kMostLevels = 2;  ///< coarse levels
/// Ties that are solved together: there are so few that half of a larger pack would be idle.
inline constexpr std::size_t kTiePack = 4;

/// The nodes that move a particle.
struct Parents {
  std::array<Index, kParents> node = {};
  std::array<float, kParents> share = {};  ///< they sum to one
};

/// The share of a particle that a node represents.
struct Child {
  Index particle = 0;
  float share = 0.0f;
};

/// Pairs of nodes that must not be farther apart than their limit, one for each slot of the schedule.
struct Ties {
  Schedule schedule;
  std::vector<Index> a, b;
  std::vector<float> limit_m;
};

/// The nodes of one level.
struct CoarseLevel {
  int sweeps = 1;                   ///< the most sweeps over the ties a substep
  std::vector<Index> node;          ///< #N: the particle at each node
  std::vector<float> inverse_mass;  ///< #N: of the represented particles
  /// #N, then points for idle slots; the weight is the inverse mass, or zero where the body holds the node.
  std::vector<Point> at;
  std::vector<Point> before;  ///< as many: the nodes when the substep began
  /// #N, meters: at first the position where the solution begins, then the displacement.
  std::vector<Point> move;
  Ties ties;
  std::vector<Parents> parents;    ///< #P
  std::vector<Index> child_begin;  ///< #N + 1: offsets into child
  std::vector<Child> child;        ///< the particles of each node, ascending
};

/// What the body does to the particles that it touches, #P each.
struct Support {
  std::span<const std::uint8_t> touching;  ///< whether it does
  std::span<const Point> normal;          ///< unit, out of the body, where it does; zero: it supports nothing
  std::span<const float> friction_share;  ///< the share of `friction` that acts; empty: all of it
  float friction = 0.0f;                  ///< coefficient of friction
};

/// The levels from the coarsest to the finest; none for a garment of a few edges. The limit of a tie is its
/// distance along the cloth, enlarged by the fraction `slack`. O(#P log #P) a level.
std::vector<CoarseLevel> make_coarse(const geometry::TriMesh& mesh, const Topology& topology,
                                     double median_edge_m, double slack);

/// Sums the masses of the nodes from the points' weights. Call it whenever these change.
void update_weights(const engine::Context& context, const Particles& particles,
                    std::vector<CoarseLevel>& levels);

/// Pulls nodes together that are farther apart than their limit, and moves the particles with them. Nodes
/// that touch the body are not pulled into it, and its friction holds them; those that hang follow them.
void solve_coarse(const engine::Context& context, const Support& support, std::vector<CoarseLevel>& levels,
                  Particles& particles);

}  // namespace bodice::cloth
