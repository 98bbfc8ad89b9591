// Coarse levels against numerical stretch: one sweep a substep lets a long piece hang like rubber, because a
// pull travels only an edge or two a sweep. A coarse node stands for the particles around it.
#pragma once

#include <array>
#include <vector>

#include <bodice/engine/context.hpp>

#include "base/particles.hpp"
#include "base/schedule.hpp"
#include "garment/topology.hpp"

namespace bodice::cloth {

inline constexpr std::size_t kParents = 4;
inline constexpr std::size_t kMostLevels = 2;
inline constexpr std::size_t kTiePack = 4;  ///< ties solved together; larger packs of so few were half idle

/// Nodes that carry a particle.
struct Parents {
  std::array<Index, kParents> node = {};
  std::array<float, kParents> share = {};  ///< they sum to one
};

/// What a node carries of a particle.
struct Child {
  Index particle = 0;
  float share = 0.0f;
};

/// Nodes that must not part further than their limit: a slot of the schedule each.
struct Ties {
  Schedule schedule;
  std::vector<Index> a, b;
  std::vector<float> limit_m;
};

struct CoarseLevel {
  int sweeps = 1;
  std::vector<Index> node;  ///< #N, the particle at each node
  std::vector<Point> at;    ///< #N, those that idle slots name; weight: inverse mass it stands for
  std::vector<Point> move;  ///< #N, meters: where a solve begins, and after it how far it went
  Ties ties;
  std::vector<Parents> parents;    ///< #P
  std::vector<Index> child_begin;  ///< #N + 1, offsets into child
  std::vector<Child> child;        ///< ascending particles
};

/// Levels from the coarsest to the finest; none for a garment of a few edges. The limit is the distance along
/// the cloth, enlarged by `slack`. O(#P log #P) a level.
std::vector<CoarseLevel> make_coarse(const geometry::TriMesh& mesh, const Topology& topology,
                                     double median_edge_m, double slack);

/// Sums the masses of the nodes from the points' weights. Whenever those change.
void update_weights(const engine::Context& context, const Particles& particles,
                    std::vector<CoarseLevel>& levels);

/// Pulls nodes together that are further apart than their limit, and the particles with them.
void solve_coarse(const engine::Context& context, std::vector<CoarseLevel>& levels, Particles& particles);

}  // namespace bodice::cloth
