// Coarse levels against numerical stretch: one sweep a substep lets a long piece hang like rubber, because a
// pull travels only an edge or two a sweep. A coarse node stands for the particles around it.
#pragma once

#include <array>
#include <vector>

#include <bodice/engine/context.hpp>

#include "particles.hpp"
#include "topology.hpp"

namespace bodice::cloth {

inline constexpr std::size_t kParents = 4;

/// Nodes that carry a particle.
struct Parents {
  std::array<Index, kParents> node = {};
  std::array<float, kParents> share = {};  ///< they sum to one
};

struct CoarseLevel {
  int sweeps = 1;
  std::vector<Index> node;       ///< #N, the particle at each node
  std::vector<Point> at;         ///< #N; its weight is the inverse mass of all that the node stands for
  std::vector<Point> move;       ///< #N, metres, of the last solve
  std::vector<Index> a, b;       ///< #C, nodes that must not part further than ...
  std::vector<float> limit_m;    ///< ... this
  std::vector<Parents> parents;  ///< #P
};

/// Levels from the coarsest to the finest; none for a garment of a few edges. The limit is the distance along
/// the cloth, enlarged by `slack`. O(#P log #P) a level.
std::vector<CoarseLevel> make_coarse(const geometry::TriMesh& mesh, const Topology& topology,
                                     double median_edge_m, double slack);

/// Sums the masses of the nodes from the points' weights. Whenever those change.
void update_weights(const Particles& particles, std::vector<CoarseLevel>& levels);

/// Pulls nodes together that are further apart than their limit, and the particles with them.
void solve_coarse(const engine::Context& context, std::vector<CoarseLevel>& levels, Particles& particles);

}  // namespace bodice::cloth
