// Files in: any format assimp reads, the body chosen among its meshes, units and axes found, vertices welded.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <bodice/engine/context.hpp>
#include <bodice/engine/result.hpp>
#include <bodice/geometry/frame.hpp>
#include <bodice/geometry/mesh_repair.hpp>

namespace bodice::io {

enum class Unit { kAuto, kMeter, kDecimeter, kCentimeter, kMillimeter, kInch, kFoot };

struct ImportOptions {
  Unit unit = Unit::kAuto;           ///< told: taken, with a warning where it makes no person's size
  std::optional<geometry::Axis> up;  ///< absent: from the file, else from the shape
  std::optional<std::string> mesh;   ///< name of the body's mesh; absent: chosen by shape
};

struct ImportedMesh {
  std::filesystem::path file;
  std::string mesh;        ///< name of the mesh or group that was taken
  std::string unit;        ///< "m", "cm", ...; "unknown" with a warning when none fits
  geometry::Frame frame;   ///< file coordinates to inside
  geometry::TriMesh skin;  ///< repaired, meters, y up
  /// #input vertices -> skin vertex or kNoIndex. Input vertices are the file's own, mesh after mesh; for OBJ,
  /// FBX and Collada, whose readers split them by corner, those of the chosen meshes in order of first use.
  std::vector<geometry::Index> vertex_of_input;  ///< #input vertices of that mesh -> skin vertex or kNoIndex
  geometry::RepairReport repair;
  std::size_t input_vertices = 0, input_triangles = 0;
  std::vector<engine::Warning> warnings;
  std::vector<engine::StageTime> stages;  ///< load, check
};

/// Reads a body. For skinned files the rest pose in world space. Errors name the file, what is wrong and what
/// to do: kNotFound, kUnreadable (not a mesh), kUnusableGeometry (nothing in it is a closed-enough surface).
engine::Result<ImportedMesh> import_body(const engine::Context& context, const std::filesystem::path& file,
                                         const ImportOptions& options = {});

/// Reads a garment (all its triangle meshes together) in the frame of the body it is for. Not welded across
/// pieces, not oriented: the cloth solver welds along seams.
engine::Result<ImportedMesh> import_garment(const engine::Context& context, const std::filesystem::path& file,
                                            const geometry::Frame& body_frame);

}  // namespace bodice::io
