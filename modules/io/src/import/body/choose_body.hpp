// Chooses the triangles of a file that are the body.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <bodice/engine/context.hpp>
#include <bodice/engine/result.hpp>
#include <bodice/geometry/mesh_repair.hpp>

#include "import/scene/file_scene.hpp"

namespace bodice::inline v0_1::io {

struct ChosenBody {
  geometry::TriMesh shape;  ///< file coordinates; vertices in the order of their meshes
  FileWeights weights;      ///< of its vertices; empty where the file has no bones
  std::string name;         ///< name of the mesh that gave most of it
  std::vector<engine::Warning> warnings;
  std::optional<geometry::RepairedMesh> repaired;  ///< the shape repaired, where the choice had to do that
};

/// All meshes of a file, or with `wanted` those of that name, as one thing. Fails with kNotFound.
engine::Result<ChosenBody> choose_all(const FileScene& scene, const std::optional<std::string>& wanted);

/// Chooses by shape: the piece with the most closed skin, and what continues it. Names are a hint only. If
/// `wanted` is given, the meshes of that name are taken instead. `person` counts the bodies of a file from 1.
/// Fails with kNotFound or kUnusableGeometry.
engine::Result<ChosenBody> choose_body(const engine::Context& context, const FileScene& scene,
                                       const std::optional<std::string>& wanted, int person);

}  // namespace bodice::io
