// Reading mesh files of any format in kMeshFormats, by their content. The body is chosen among the meshes,
// its unit and axes are found, and its vertices are welded.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <bodice/engine/context.hpp>
#include <bodice/engine/result.hpp>
#include <bodice/geometry/frame.hpp>
#include <bodice/geometry/mesh_repair.hpp>

namespace bodice::inline v0_1::io {

/// The formats of mesh files that are read, as messages and helps name them.
inline constexpr std::string_view kMeshFormats = "OBJ, PLY, STL, glTF 2, FBX or Collada";

/// How a garment looks: the materials, images and texture coordinates of its file, and its name. It is made
/// by import_garment() and used by write_glb() for a mesh with the same triangles.
struct Look;

/// A unit of length of a file; kAuto finds it.
enum class Unit { kAuto, kMeter, kDecimeter, kCentimeter, kMillimeter, kInch, kFoot };

/// The content that is expected of a file: a person, that is searched for in it, or a thing, which is all of
/// it.
enum class Shape { kPerson, kAny };

/// Properties of a body file that the caller gives; absent ones are found.
struct ImportOptions {
  /// With kAny nothing is guessed by a person's size and shape: all meshes are taken, the unit is the given
  /// one, else the file's, else meters, with a warning; up is the given axis, else the file's, else y.
  Shape shape = Shape::kPerson;
  /// With kAny: unit and axes of another file with the same coordinates; `unit` and `up` are not
  /// read.
  std::optional<geometry::Frame> frame;
  Unit unit = Unit::kAuto;  ///< a given unit is kept, with a warning where the body has no person's size
  std::optional<geometry::Axis> up;  ///< absent: as the file states, else by shape
  std::optional<std::string> mesh;   ///< name of the body's mesh; absent: chosen by shape
  int person = 1;                    ///< which body of a file with several people, from 1
  bool keep_noise = false;           ///< noise of a scan is measured, and not smoothed
  bool keep_vertices = false;        ///< skins of more than 300,000 vertices are not thinned
};

/// A repaired mesh in meters, y up, and its relation to the file.
struct ImportedMesh {
  std::filesystem::path file;
  Shape shape = Shape::kPerson;  ///< what it is analyzed as
  std::string mesh;              ///< name of the chosen mesh or group
  std::string unit;              ///< "m", "cm", ...; "unknown" with a warning when none fits
  geometry::Frame frame;         ///< maps the file's coordinates to the skin's
  /// Whether neither the caller nor the file gave the up axis; landmarks may correct it.
  bool up_found_by_extents = false;
  geometry::TriMesh skin;  ///< the repaired mesh, meters, y up
  /// #input vertices -> skin vertex or kNoIndex. Input vertices are those of the file, mesh after mesh. OBJ,
  /// FBX and Collada are split by corner when they are read; there they are those of the chosen meshes, in
  /// order of first use.
  std::vector<geometry::Index> vertex_of_input;
  /// #V: 1 where the file has no skin and the vertex closes a hole; empty where the skin was not rebuilt.
  std::vector<std::uint8_t> made_up;
  geometry::RepairReport repair;
  std::size_t input_vertices = 0, input_triangles = 0;
  std::vector<engine::Warning> warnings;
  std::vector<engine::StageTime> stages;  ///< times of "load" and "check"
  /// Standard deviation of a scan's noise along the normals; 0 for clean skins, things and bodies with bones.
  double noise_m = 0.0;
  bool smoothed = false;             ///< whether that noise was taken out of the skin
  std::shared_ptr<const Look> look;  ///< how a garment looks; null for a body and where the file has none
};

/// Reads a body; of a skinned file, in its bind pose in world space. Fails with kNotFound, kUnreadable (not a
/// mesh) or kUnusableGeometry (nothing in it is a sufficiently closed surface). Errors name the file, what is
/// wrong and the remedy. Cost: O(n log n).
engine::Result<ImportedMesh> import_body(const engine::Context& context, const std::filesystem::path& file,
                                         const ImportOptions& options = {});

/// Reads a garment (all triangle meshes of the file together) in the frame of its body. It is neither welded
/// across pieces nor oriented, since the cloth solver welds seams. Fails as import_body() does.
engine::Result<ImportedMesh> import_garment(const engine::Context& context, const std::filesystem::path& file,
                                            const geometry::Frame& body_frame);

/// The files beside this one that hold part of it, in its order, whether they are there or not: buffers and
/// images of a glTF document, material libraries of an OBJ and their images. None for every other format, and
/// for data inside of the document. Cost: reading the file.
std::vector<std::filesystem::path> files_beside(const std::filesystem::path& file);

}  // namespace bodice::io
