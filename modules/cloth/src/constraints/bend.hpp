// Hinges as isometric bending constraints with a physical compliance.
#pragma once

#include <array>
#include <vector>

#include <bodice/cloth/fabric.hpp>
#include <bodice/engine/context.hpp>

#include "base/particles.hpp"
#include "base/schedule.hpp"
#include "garment/topology.hpp"

namespace bodice::inline v0_1::cloth {

/// Hinges that share no particle; those of idle slots have weights of zero. The constraint is n . sum_i k_i
/// x_i - rest, with n the hinge's normal.
template <class Id>
struct HingePack {
  Id corner[4][kPack];  ///< the edge's ends, then the two opposite corners
  Half k[3][kPack];  ///< cotangent weights of all but the first corner; the weights of all four sum to zero
  Half compliance[kPack];  ///< meters a newton
  float rest_m[kPack];
  float held[kPack];  ///< the value at which friction holds the hinge
};

static_assert(sizeof(HingePack<Local>) ==
              24 * kPack);  // memory bandwidth bounds a sweep over a large garment

/// Friction between yarns. A second spring pulls each hinge toward a held value, which follows the hinge once
/// the spring's force exceeds a limit.
struct YarnFriction {
  float soften = 1.0f;  ///< compliance of both springs together, as a share of the bending compliance alone
  float slip_n = 0.0f;  ///< force at which the held value slips; times a hinge's compliance, its largest
                        ///< distance from the hinge
};

/// All hinges of a garment.
struct BendConstraints {
  Schedule schedule;
  YarnFriction yarn;
  std::vector<HingePack<Local>> inside;  ///< packs inside blocks
  std::vector<HingePack<Index>> across;  ///< packs across blocks
};

/// The hinges of a garment; none if the fabric has no bending stiffness.
BendConstraints make_bend(const geometry::TriMesh& mesh, const Topology& topology, const Fabric& fabric,
                          const Particles& particles);

/// Solves the hinges inside a block. A Gauss-Seidel sweep consists of all blocks, in any order, then of the
/// constraints across them. `inverse_h2` is the number of sweeps in a substep over the square of its length.
void solve_bend_block(BendConstraints& constraints, std::size_t block, float inverse_h2, Patch& patch);
/// Solves the hinges across blocks.
void solve_bend_across(const engine::Context& context, BendConstraints& constraints, float inverse_h2,
                       Particles& particles);

/// The potential energy of all hinges, joules, with that of the springs of friction.
double bend_energy(const engine::Context& context, const BendConstraints& constraints,
                   const Particles& particles);

}  // namespace bodice::cloth
