// Edges as distance constraints with a physical compliance and a strain limit.
#pragma once

#include <span>
#include <vector>

#include <bodice/cloth/fabric.hpp>
#include <bodice/engine/context.hpp>

#include "base/particles.hpp"
#include "base/schedule.hpp"
#include "garment/topology.hpp"

namespace bodice::cloth {

/// Edges that share no particle; idle ones have no length and no weight.
template <class Id>
struct EdgePack {
  Id a[kPack], b[kPack];
  float rest_m[kPack];
  float compliance[kPack];  ///< meters a newton
};

static_assert(sizeof(EdgePack<Local>) == 12 * kPack);  // a large garment's sweep is as fast as memory

struct StretchConstraints {
  Schedule schedule;
  std::size_t edges = 0;
  float longest = 1.0f;  ///< length allowed, in rest lengths
  std::vector<EdgePack<Local>> inside;
  std::vector<EdgePack<Index>> across;

  std::size_t slots() const { return kPack * schedule.packs(); }
};

StretchConstraints make_stretch(const geometry::TriMesh& mesh, const Topology& topology, const Fabric& fabric,
                                const Particles& particles);

/// A Gauss-Seidel sweep is all blocks, in any order, then what lies across them. `inverse_h2` is sweeps a
/// substep over its length squared.
void solve_stretch_block(const StretchConstraints& constraints, std::size_t block, float inverse_h2,
                         Patch& patch);
void solve_stretch_across(const engine::Context& context, const StretchConstraints& constraints,
                          float inverse_h2, Particles& particles);

struct Strain {
  double energy_j = 0.0;  ///< potential, of all edges
  float longest = 0.0f;   ///< largest elongation
};

/// Also writes the strain of each slot (0 of idle ones).
Strain measure_stretch(const engine::Context& context, const StretchConstraints& constraints,
                       const Particles& particles, std::span<float> strain);

}  // namespace bodice::cloth
