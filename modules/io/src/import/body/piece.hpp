// A piece is a connected part of the whole file's surface, across all meshes.
#pragma once

#include <map>
#include <vector>

#include <bodice/engine/context.hpp>
#include <bodice/engine/result.hpp>
#include <bodice/geometry/mesh_repair.hpp>

#include "import/scene/file_scene.hpp"

namespace bodice::inline v0_1::io {

/// All triangles of a file, welded by position, with the mesh that each came from.
struct JoinedScene {
  geometry::TriMesh mesh;
  std::vector<std::size_t> source;                      ///< #F: index into FileScene::meshes
  std::vector<std::vector<geometry::Index>> vertex_of;  ///< mesh of the file -> its vertex -> joined vertex
  geometry::RepairedMesh repaired;                      ///< the rest of the repair; its mesh is the one above
};

struct Piece {
  std::vector<geometry::Index> triangles;        ///< of the joined mesh
  std::map<std::size_t, double> area_of_source;  ///< index into FileScene::meshes -> file units squared
  geometry::Box box;
  double area = 0.0;             ///< file units squared
  double boundary_length = 0.0;  ///< sum over edges that have one triangle, file units
  double volume = 0.0;           ///< enclosed, absolute, file units cubed

  /// Boundary length over the square root of the area, without unit. It is 0 for a closed piece, about 0.3
  /// for a body with open eyes and mouth, 1.5 and more for trousers, shirts and skirts.
  double openness() const;
  /// The mesh that gave most of the area.
  std::size_t main_source() const;
};

engine::Result<JoinedScene> join(const engine::Context& context, const FileScene& scene);

/// The connected parts, largest area first.
std::vector<Piece> split(const JoinedScene& joined);

}  // namespace bodice::io
