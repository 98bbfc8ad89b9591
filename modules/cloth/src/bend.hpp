// Hinges as isometric bending constraints with a physical compliance.
#pragma once

#include <array>
#include <vector>

#include <bodice/cloth/fabric.hpp>
#include <bodice/engine/context.hpp>

#include "particles.hpp"
#include "schedule.hpp"
#include "topology.hpp"

namespace bodice::cloth {

/// A slot of the schedule each; idle slots have weights of zero. The constraint is n . sum_i k_i x_i - rest,
/// n the hinge's normal.
struct BendConstraints {
  Schedule schedule;
  std::array<std::vector<Index>, 4> corner;  ///< the edge's ends, then the two opposite corners
  std::array<std::vector<float>, 4> k;       ///< cotangent weights, they sum to zero
  std::vector<float> rest_m;
  std::vector<float> compliance;  ///< metres a newton
  std::vector<float> held;        ///< value at which friction holds it
  float soften = 1.0f;            ///< compliance of both springs together, in that of bending
  float slip_n = 0.0f;            ///< friction gives way this far from held, in compliances
};

BendConstraints make_bend(const geometry::TriMesh& mesh, const Topology& topology, const Fabric& fabric,
                          const Particles& particles);

/// A Gauss-Seidel sweep is all blocks, in any order, then what lies across them. `inverse_h2` is sweeps a
/// substep over its length squared.
void solve_bend_block(BendConstraints& constraints, std::size_t block, float inverse_h2,
                      Particles& particles);
void solve_bend_across(const engine::Context& context, BendConstraints& constraints, float inverse_h2,
                       Particles& particles);

/// Potential energy of all hinges, joules, that of what friction holds included.
double bend_energy(const engine::Context& context, const BendConstraints& constraints,
                   const Particles& particles);

}  // namespace bodice::cloth
