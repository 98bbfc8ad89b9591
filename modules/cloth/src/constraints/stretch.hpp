// Edges as distance constraints with a physical compliance and a strain limit.
#pragma once

#include <span>
#include <vector>

#include <bodice/cloth/fabric.hpp>
#include <bodice/engine/context.hpp>

#include "base/particles.hpp"
#include "base/schedule.hpp"
#include "garment/topology.hpp"

namespace bodice::inline v0_1::cloth {

/// Edges that share no particle; those of idle slots have no length and no weight.
template <class Id>
struct EdgePack {
  Id a[kPack], b[kPack];
  float rest_m[kPack];
  float compliance[kPack];  ///< meters a newton
};

static_assert(sizeof(EdgePack<Local>) == 12 * kPack);  // memory bandwidth bounds a sweep over a large garment

/// All edges of a garment.
struct StretchConstraints {
  Schedule schedule;
  std::size_t edges = 0;                ///< number of edges
  float longest = 1.0f;                 ///< allowed length, in rest lengths
  std::vector<EdgePack<Local>> inside;  ///< packs inside blocks
  std::vector<EdgePack<Index>> across;  ///< packs across blocks

  std::size_t slots() const { return kPack * schedule.packs(); }
};

/// The edges of a garment.
StretchConstraints make_stretch(const geometry::TriMesh& mesh, const Topology& topology, const Fabric& fabric,
                                const Particles& particles);

/// Solves the edges inside a block. A Gauss-Seidel sweep consists of all blocks, in any order, then of the
/// constraints across them. `inverse_h2` is the number of sweeps in a substep over the square of its length.
void solve_stretch_block(const StretchConstraints& constraints, std::size_t block, float inverse_h2,
                         Patch& patch);
/// Solves the edges across blocks.
void solve_stretch_across(const engine::Context& context, const StretchConstraints& constraints,
                          float inverse_h2, Particles& particles);

/// The measurement of edges.
struct Strain {
  double energy_j = 0.0;  ///< potential energy
  float longest = 0.0f;   ///< largest elongation, as strain
};

/// Measures all edges, and writes the strain of each slot (0 for idle ones).
Strain measure_stretch(const engine::Context& context, const StretchConstraints& constraints,
                       const Particles& particles, std::span<float> strain);

/// Raises `most` (#P) to the largest strain of each particle's edges, among strains that exceed `above`.
/// `strain` has one value for each slot.
void raise_to_strain(const StretchConstraints& constraints, std::span<const float> strain, float above,
                     std::span<float> most);

}  // namespace bodice::cloth
