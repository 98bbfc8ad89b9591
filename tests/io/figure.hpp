// A figure of known size and volume, and writers of meshes in every text and binary format.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <bodice/engine/context.hpp>
#include <bodice/geometry/tri_mesh.hpp>

namespace io_test {

using bodice::geometry::TriMesh;
using bodice::geometry::Vec3;

inline const bodice::engine::Context kContext;  ///< one worker, no log
inline constexpr const char* kIdentity = "[1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]";

/// A closed body-like surface: 1.7 m tall, standing on y = 0, 642 vertices, about 1.9 m2, wider at the top,
/// mirror-symmetric in x but not in z.
TriMesh figure();

/// The mesh with every position mapped.
template <class Map>
TriMesh mapped(TriMesh mesh, Map&& map) {
  for (Vec3& p : mesh.positions) p = map(p);
  return mesh;
}

/// The largest distance from a vertex of one mesh to the closest vertex of the other, in both directions. It
/// is found by brute force.
double vertex_distance(const TriMesh& a, const TriMesh& b);

struct NamedMesh {
  std::string name;
  TriMesh mesh;
};

std::string to_obj(const std::vector<NamedMesh>& groups);
std::string to_ply(const TriMesh& mesh, bool binary);
std::string to_stl(const TriMesh& mesh, bool binary);
/// A Collada document with unit and up axis, and a geometry a mesh.
std::string to_collada(const std::vector<NamedMesh>& meshes, double meters_per_unit,
                       std::string_view up_axis);
/// A mesh under a node with this column-major matrix. If `joint_matrix` is not empty, the mesh is skinned to
/// one joint, and that is the matrix of the joint's node (its bind pose).
std::string to_gltf(const TriMesh& mesh, const std::string& node_matrix,
                    const std::string& joint_matrix = {});

}  // namespace io_test
