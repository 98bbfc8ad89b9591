// Edges as distance constraints with a physical compliance and a strain limit.
#pragma once

#include <vector>

#include <bodice/cloth/fabric.hpp>
#include <bodice/engine/context.hpp>

#include "particles.hpp"
#include "topology.hpp"

namespace bodice::cloth {

/// #E each, grouped by colour.
struct StretchConstraints {
  std::vector<Index> a, b;
  std::vector<float> rest_m;
  std::vector<float> limit_m;     ///< longest length allowed
  std::vector<float> compliance;  ///< metres a newton
  std::vector<std::uint32_t> color_begin;

  std::size_t count() const { return a.size(); }
};

StretchConstraints make_stretch(const geometry::TriMesh& mesh, const Topology& topology, const Fabric& fabric,
                                const Particles& particles);

/// One Gauss-Seidel sweep over all colours; `inverse_h2` is sweeps a substep over its length squared.
void solve_stretch(const engine::Context& context, const StretchConstraints& constraints, float inverse_h2,
                   Particles& particles);

/// Potential energy of all edges, joules. Serial.
double stretch_energy(const StretchConstraints& constraints, const Particles& particles);

}  // namespace bodice::cloth
