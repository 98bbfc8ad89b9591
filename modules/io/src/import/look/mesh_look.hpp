// How the meshes of a file look, before they are joined to one garment.
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include <bodice/engine/result.hpp>
#include <bodice/geometry/tri_mesh.hpp>

#include "look/look.hpp"

namespace bodice::inline v0_1::io {

/// The look of one mesh of a file.
struct MeshLook {
  std::string node;  ///< the name of its node; empty where the file gives none
  std::size_t uv_sets = 0;
  std::vector<float> uv;                 ///< #F x 3 x uv_sets x 2, as Look has them
  std::uint32_t material = kNoMaterial;  ///< into FileLook::materials
};

/// What the meshes of a file share.
struct FileLook {
  Materials materials;
  std::vector<engine::Warning> warnings;  ///< they name images that are left out
};

}  // namespace bodice::io
