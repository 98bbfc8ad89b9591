// What a file holds before anything is judged: triangle meshes in the file's own world coordinates.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <bodice/engine/context.hpp>
#include <bodice/engine/result.hpp>
#include <bodice/geometry/frame.hpp>
#include <bodice/geometry/tri_mesh.hpp>

#include "file_rig.hpp"

namespace bodice::io {

struct FileMesh {
  std::string name;         ///< of the mesh, else of its node; may be empty
  std::string material;     ///< may be empty
  geometry::TriMesh shape;  ///< file units and axes, node transforms applied
  FileWeights weights;      ///< of its vertices; empty where the file has no bones
};

struct FileScene {
  std::vector<FileMesh> meshes;  ///< those with at least one triangle
  FileRig rig;
  std::optional<double> meters_per_unit;  ///< what the file says of itself
  std::optional<geometry::Axis> up;       ///< what the file says of itself
  bool kept_digits = false;               ///< read in more than single precision
};

/// Reads any format that assimp knows. Skinned meshes come in their bind pose. Points and lines are left
/// out, polygons triangulated. Fails with kNotFound or kUnreadable.
engine::Result<FileScene> read_scene(const std::filesystem::path& file);

/// The same, but a file without triangles will do.
engine::Result<FileScene> read_motion_scene(const std::filesystem::path& file);

/// Appends a mesh's vertices and triangles to another's.
void append(const geometry::TriMesh& mesh, geometry::TriMesh& to);

/// Makes one vertex of those with coordinates that are the same to the bit, in the order of their first use:
/// some formats have no vertices of their own once assimp has split them by corner. The first one's weights
/// stay. O(#V).
void share_vertices(FileMesh& mesh);

}  // namespace bodice::io
