// Hinges as isometric bending constraints with a physical compliance.
#pragma once

#include <array>
#include <vector>

#include <bodice/cloth/fabric.hpp>
#include <bodice/engine/context.hpp>

#include "base/particles.hpp"
#include "base/schedule.hpp"
#include "garment/topology.hpp"

namespace bodice::cloth {

/// Hinges that share no particle; idle ones have weights of zero. The constraint is n . sum_i k_i x_i - rest,
/// n the hinge's normal.
template <class Id>
struct HingePack {
  Id corner[4][kPack];     ///< the edge's ends, then the two opposite corners
  Half k[3][kPack];        ///< cotangent weights of all but the first corner: they sum to zero
  Half compliance[kPack];  ///< meters a newton
  float rest_m[kPack];
  float held[kPack];  ///< value at which friction holds it
};

static_assert(sizeof(HingePack<Local>) == 24 * kPack);  // a large garment's sweep is as fast as memory

/// A spring to where each hinge is held, beside that to its rest shape.
struct YarnFriction {
  float soften = 1.0f;  ///< compliance of both springs together, in that of bending
  float slip_n = 0.0f;  ///< friction gives way this far from held, in compliances
};

struct BendConstraints {
  Schedule schedule;
  YarnFriction yarn;
  std::vector<HingePack<Local>> inside;
  std::vector<HingePack<Index>> across;
};

BendConstraints make_bend(const geometry::TriMesh& mesh, const Topology& topology, const Fabric& fabric,
                          const Particles& particles);

/// A Gauss-Seidel sweep is all blocks, in any order, then what lies across them. `inverse_h2` is sweeps a
/// substep over its length squared.
void solve_bend_block(BendConstraints& constraints, std::size_t block, float inverse_h2, Patch& patch);
void solve_bend_across(const engine::Context& context, BendConstraints& constraints, float inverse_h2,
                       Particles& particles);

/// Potential energy of all hinges, joules, that of what friction holds included.
double bend_energy(const engine::Context& context, const BendConstraints& constraints,
                   const Particles& particles);

}  // namespace bodice::cloth
