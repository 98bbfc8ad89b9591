// One closed skin for bodies that files give in patches, in pieces or with large holes.
#pragma once

#include <optional>
#include <vector>

#include <bodice/engine/context.hpp>
#include <bodice/engine/result.hpp>
#include <bodice/geometry/mesh_repair.hpp>

namespace bodice::io {

/// Makes a closed skin of what repair() made of `input`, if that is not nearly closed already. The result
/// maps input vertices to the nearest vertex of the new skin, and its warnings state how much of it the file
/// does not have. Empty where nothing has to be done, or nothing can be. O(n log n), below a second for a
/// body.
std::optional<geometry::RepairedMesh> close_skin(const engine::Context& context,
                                                 const geometry::TriMesh& input,
                                                 const geometry::RepairedMesh& repaired);

}  // namespace bodice::io
