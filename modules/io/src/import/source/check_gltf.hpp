// What must hold of a glTF document before assimp may read it: its reader follows these references unchecked.
#pragma once

#include <filesystem>

#include <bodice/engine/result.hpp>

#include "import/source/gltf_document.hpp"

namespace bodice::inline v0_1::io {

/// Checks that skins have an inverse bind matrix a joint, that vertices' joints and weights can be read, and
/// that animations have values for their times. Fails with kUnreadable and names the skin, the mesh or the
/// animation.
engine::Result<void> check_gltf(const GltfDocument& document, const std::filesystem::path& file);

}  // namespace bodice::io
