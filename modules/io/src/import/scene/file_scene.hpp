// The content of a file before any choice: triangle meshes in the file's world coordinates.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <bodice/engine/context.hpp>
#include <bodice/engine/result.hpp>
#include <bodice/geometry/frame.hpp>
#include <bodice/geometry/tri_mesh.hpp>

#include "import/look/mesh_look.hpp"
#include "import/scene/file_rig.hpp"

namespace bodice::inline v0_1::io {

struct FileMesh {
  std::string name;         ///< the mesh's name, else its node's; may be empty
  std::string material;     ///< may be empty
  geometry::TriMesh shape;  ///< file units and axes, node transforms applied
  FileWeights weights;      ///< of its vertices; empty where the file has no bones
  MeshLook look;            ///< read with LookOf::kGarment
};

struct FileScene {
  std::vector<FileMesh> meshes;  ///< meshes with at least one triangle
  FileRig rig;
  FileLook look;                          ///< read with LookOf::kGarment
  std::optional<double> meters_per_unit;  ///< the unit that the file states
  std::optional<geometry::Axis> up;       ///< the axis that the file states
  bool kept_digits = false;               ///< whether positions were read in more than single precision
};

/// Whether materials, images and texture coordinates are read: those of garments alone are used.
enum class LookOf { kNothing, kGarment };

/// Reads any format that assimp reads. Skinned meshes are in their bind pose. Points and lines are left out,
/// polygons are triangulated. Fails with kNotFound or kUnreadable.
engine::Result<FileScene> read_scene(const std::filesystem::path& file, LookOf look = LookOf::kNothing);

/// The same, but a file without triangles will do.
engine::Result<FileScene> read_motion_scene(const std::filesystem::path& file,
                                            LookOf look = LookOf::kNothing);

/// Appends a mesh's vertices and triangles to another's.
void append(const geometry::TriMesh& mesh, geometry::TriMesh& to);

/// Merges vertices with the same bits, in the order of their first use, with the weights of the first one.
/// Formats that assimp splits by corner have no other vertices. O(#V).
void share_vertices(FileMesh& mesh);

}  // namespace bodice::io
