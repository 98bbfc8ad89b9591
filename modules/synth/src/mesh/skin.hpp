// The skin of a figure in its rest pose: a cage stretched over the flesh.
#pragma once

#include <optional>

#include <bodice/engine/context.hpp>

#include "mesh/patches.hpp"

namespace bodice::inline v0_1::synth {

/// A cage relaxed on the flesh at a fixed resolution. Every final mesh is sampled from it, so that a body has
/// the same shape at all resolutions.
struct Skin {
  Cage cage;
  PatchMesh mesh;
  std::vector<Vec3> positions;  ///< #mesh vertices, statures
};

Skin make_skin(const engine::Context& context, const Figure& figure, const Flesh& flesh);

/// Moves the skin to another flesh of the same figure, and relaxes it.
void settle(const engine::Context& context, const Flesh& flesh, Skin& skin, int relaxations);

/// The volume enclosed by quads, in cubic units.
double volume(const PatchMesh& mesh, const std::vector<Vec3>& positions);

/// The points of a finer or coarser mesh on the flesh.
std::vector<Vec3> sample_skin(const engine::Context& context, const Skin& skin, const Flesh& flesh,
                              const PatchMesh& mesh);

/// Neighbors along quad edges, in compressed rows.
struct Neighbors {
  std::vector<std::size_t> start;  ///< #V + 1
  std::vector<geometry::Index> vertex;
  explicit Neighbors(const PatchMesh& mesh);
};

}  // namespace bodice::synth
