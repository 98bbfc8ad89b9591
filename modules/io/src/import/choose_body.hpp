// Which triangles of a file are the body.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <bodice/engine/context.hpp>
#include <bodice/engine/result.hpp>

#include "file_scene.hpp"

namespace bodice::io {

struct ChosenBody {
  geometry::TriMesh shape;  ///< file coordinates; vertices in the order of their meshes
  FileWeights weights;      ///< of its vertices; empty where the file has no bones
  std::string name;         ///< of the mesh that gave most of it
  std::vector<engine::Warning> warnings;
};

/// Chooses by shape: the piece with the most closed skin, and what continues it. Names are a hint only.
/// `wanted` takes the meshes of that name instead. Fails with kNotFound or kUnusableGeometry.
engine::Result<ChosenBody> choose_body(const engine::Context& context, const FileScene& scene,
                                       const std::optional<std::string>& wanted);

}  // namespace bodice::io
