// One closed skin for bodies that files give in patches, in pieces or with large holes.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include <bodice/engine/context.hpp>
#include <bodice/engine/result.hpp>
#include <bodice/geometry/mesh_repair.hpp>

namespace bodice::inline v0_1::io {

/// A closed skin, and which of its vertices the file does not have.
struct ClosedSkin {
  geometry::RepairedMesh repaired;
  std::vector<std::uint8_t> made_up;  ///< #V
};

/// Makes a closed skin of what repair() made of `input`, if that is not nearly closed already. The result
/// maps input vertices to the nearest vertex of the new skin, and its warnings state how much of it the file
/// does not have. Empty where nothing has to be done, or nothing can be. O(n log n), below a second for a
/// body.
std::optional<ClosedSkin> close_skin(const engine::Context& context, const geometry::TriMesh& input,
                                     const geometry::RepairedMesh& repaired);

}  // namespace bodice::io
