// The skin of a figure in its rest pose: a cage stretched over the flesh.
#pragma once

#include <optional>

#include <bodice/engine/context.hpp>

#include "mesh/patches.hpp"

namespace bodice::synth {

/// A cage pulled onto the flesh and evened out, at a fixed resolution that every final mesh is sampled from,
/// so that one body has the same shape at all resolutions.
struct Skin {
  Cage cage;
  PatchMesh mesh;
  std::vector<Vec3> positions;  ///< #mesh vertices, units of stature
};

Skin make_skin(const engine::Context& context, const Figure& figure, const Flesh& flesh);

/// Moves the skin to another flesh of the same figure and evens it out.
void settle(const engine::Context& context, const Flesh& flesh, Skin& skin, int relaxations);

/// Volume enclosed by quads, cubic units.
double volume(const PatchMesh& mesh, const std::vector<Vec3>& positions);

/// The finer or coarser mesh's points on the flesh.
std::vector<Vec3> sample_skin(const engine::Context& context, const Skin& skin, const Flesh& flesh,
                              const PatchMesh& mesh);

/// Neighbors along quad edges, in rows of a compressed list.
struct Neighbors {
  std::vector<std::size_t> start;  ///< #V + 1
  std::vector<geometry::Index> vertex;
  explicit Neighbors(const PatchMesh& mesh);
};

}  // namespace bodice::synth
