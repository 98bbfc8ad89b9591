#pragma once

#include <memory>
#include <span>

#include "import/scene/file_scene.hpp"

namespace bodice::inline v0_1::io {

/// The looks of all meshes, in their order, for the triangles that repair kept; null where the file has
/// none. `triangle_of_input` is that of geometry::RepairedMesh. O(#F).
std::shared_ptr<const Look> joined_look(FileLook file, std::span<const FileMesh> meshes,
                                        std::span<const geometry::Index> triangle_of_input);

}  // namespace bodice::io
