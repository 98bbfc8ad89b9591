// Hinges as isometric bending constraints with a physical compliance.
#pragma once

#include <array>
#include <vector>

#include <bodice/engine/context.hpp>

#include "particles.hpp"
#include "topology.hpp"

namespace bodice::cloth {

/// #H each, grouped by colour. The constraint is n . sum_i k_i x_i - rest, n the hinge's normal.
struct BendConstraints {
  std::array<std::vector<Index>, 4> corner;  ///< the edge's ends, then the two opposite corners
  std::array<std::vector<float>, 4> k;       ///< cotangent weights, they sum to zero
  std::vector<float> rest_m;
  std::vector<float> compliance;  ///< metres a newton
  std::vector<std::uint32_t> color_begin;

  std::size_t count() const { return rest_m.size(); }
};

BendConstraints make_bend(const geometry::TriMesh& mesh, const Topology& topology, double bend_n_m,
                          const Particles& particles);

/// One Gauss-Seidel sweep over all colours; `inverse_h2` is sweeps a substep over its length squared.
void solve_bend(const engine::Context& context, const BendConstraints& constraints, float inverse_h2,
                Particles& particles);

/// Potential energy of all hinges, joules. Serial.
double bend_energy(const BendConstraints& constraints, const Particles& particles);

}  // namespace bodice::cloth
