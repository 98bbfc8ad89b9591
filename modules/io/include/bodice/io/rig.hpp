// Rigs and motions from files, and rigged bodies to files.
#pragma once

#include <filesystem>
#include <vector>

#include <bodice/engine/context.hpp>
#include <bodice/engine/result.hpp>
#include <bodice/geometry/tri_mesh.hpp>
#include <bodice/io/import.hpp>
#include <bodice/rig/rig.hpp>

namespace bodice::inline v0_1::io {

/// A body and what moves it. The rig's weights are those of body.skin, its bind pose is the skin as imported.
struct RiggedBody {
  ImportedMesh body;
  /// One sentence where there is none: kNotFound (the file has no skeleton) or kUnusableGeometry (a bad one).
  engine::Result<rig::Rig> rig = engine::Error{};
};

/// Reads a body as import_body() does, with its skeleton, weights and clips in meters, y up. Skinned meshes
/// that the body is joined from share one skeleton. Fails where import_body() fails; warnings go to
/// body.warnings. Cubic and step keys are kept for glTF; assimp's readers of other formats give linear keys.
engine::Result<RiggedBody> import_rigged_body(const engine::Context& context,
                                              const std::filesystem::path& file,
                                              const ImportOptions& options = {});

/// A skeleton and its clips without a skin.
struct ImportedMotion {
  std::filesystem::path file;
  rig::Skeleton skeleton;  ///< meters, y up; the bind pose is the rest pose where the file has none
  std::vector<rig::Clip> clips;
  std::string unit;  ///< of the file: "m", "cm", ...; "unknown" with a warning when none fits
  std::vector<engine::Warning> warnings;
};

/// Reads the skeleton and the clips of a BVH, glTF, FBX or Collada file, whether or not it holds a skin.
/// Fails with kNotFound, kUnreadable, or kUnusableGeometry where nothing moves.
engine::Result<ImportedMotion> import_motion(const engine::Context& context,
                                             const std::filesystem::path& file);

/// Writes a skin with its rig as binary glTF 2.0 in meters, y up: a skinned mesh, the joints' nodes, inverse
/// bind matrices, and an animation a clip. Vertices keep all their weights, four a set, strongest first (many
/// viewers read the first set alone). Fails with kInvalidArgument or kUnusableGeometry where rig and skin do
/// not fit, and with kWriteFailed. The file appears whole or not at all.
engine::Result<void> write_rigged_glb(const geometry::TriMesh& skin, const rig::Rig& rig,
                                      const std::filesystem::path& file);

}  // namespace bodice::io
