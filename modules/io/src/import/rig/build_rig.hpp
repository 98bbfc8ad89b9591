// Makes the rig of the imported skin of a file's rig and the chosen body's weights.
#pragma once

#include <span>
#include <vector>

#include <bodice/engine/result.hpp>
#include <bodice/geometry/frame.hpp>
#include <bodice/geometry/tri_mesh.hpp>
#include <bodice/rig/rig.hpp>

#include "import/scene/file_rig.hpp"

namespace bodice::inline v0_1::io {

/// The rig of `skin`, made of input vertices by `vertex_of_input` (#input -> skin vertex or kNoIndex);
/// `weights` are the input's, and the first input vertex of a weld gives its own. Vertices without weights
/// take those of a neighbor. Fails with one sentence that names the bone; what was mended is added to
/// `warnings`.
engine::Result<rig::Rig> build_rig(const FileRig& file, const FileWeights& weights,
                                   const geometry::TriMesh& skin,
                                   std::span<const geometry::Index> vertex_of_input,
                                   const geometry::Frame& frame, std::vector<engine::Warning>& warnings);

}  // namespace bodice::io
