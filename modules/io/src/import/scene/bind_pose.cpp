// The position of a skinned mesh in the world. A skinned vertex is sum_j w_j B_j O_j v, with O_j the bone's
// offset matrix (mesh space to bone space at bind time) and B_j the bone's node matrix. In the bind pose
// every B_j O_j is one and the same matrix, which takes the mesh to the world. The node that holds the mesh
// may have another one (glTF ignores that node's transform for skinned meshes).
#include "import/scene/bind_pose.hpp"

#include <algorithm>

#include <Eigen/Geometry>

namespace bodice::inline v0_1::io {

namespace {

/// Matrices that differ less, relative to the mesh's scale, are equal: the bones are as they were bound.
constexpr double kSameMatrix = 1e-3;
/// A root bone turned by more than this against its mesh's node is oriented differently, not posed.
constexpr double kPosedRoot_rad = 0.8;

double scale_of(const Eigen::Matrix4d& matrix) {
  return std::cbrt(std::abs(matrix.topLeftCorner<3, 3>().determinant()));
}

double mesh_size(const aiMesh& mesh) {
  double size = 0.0;
  for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
    const double length = static_cast<double>(mesh.mVertices[i].Length());
    if (std::isfinite(length)) size = std::max(size, length);
  }
  return size;
}

/// Whether two matrices move a mesh of this size by less than the tolerance from each other.
bool same_position(const Eigen::Matrix4d& a, const Eigen::Matrix4d& b, double size) {
  const double turn = (a - b).topLeftCorner<3, 3>().norm() * size;
  const double shift = (a - b).topRightCorner<3, 1>().norm();
  return turn + shift <= kSameMatrix * size * scale_of(a);
}

/// Whether the bone is posed only: its scale is the node's, and its orientation is close to it.
bool merely_posed(const Eigen::Matrix4d& root, const Eigen::Matrix4d& node) {
  const double scale = scale_of(node);
  if (!(scale > 0.0) || std::abs(scale_of(root) / scale - 1.0) > 0.05) return false;
  const Eigen::Matrix3d turn =
      root.topLeftCorner<3, 3>() * node.topLeftCorner<3, 3>().transpose() / (scale * scale);
  return std::acos(std::clamp(0.5 * (turn.trace() - 1.0), -1.0, 1.0)) < kPosedRoot_rad;
}

}  // namespace

Eigen::Matrix4d to_eigen(const aiMatrix4x4& matrix) {
  Eigen::Matrix4d result;
  for (unsigned row = 0; row < 4; ++row)
    for (unsigned column = 0; column < 4; ++column)
      result(row, column) = static_cast<double>(matrix[row][column]);
  return result;
}

Eigen::Matrix4d mesh_to_world(std::span<const FileBone> bones, std::span<const FileNode> nodes,
                              const aiMesh& mesh, const Eigen::Matrix4d& node_to_world) {
  const double size = mesh_size(mesh);
  Eigen::Matrix4d root = node_to_world;
  int root_depth = 0;
  bool agree = true;
  for (const FileBone& bone : bones) {
    const FileNode& node = nodes[bone.node];
    const Eigen::Matrix4d placed = node.to_world * bone.offset;
    if (!placed.allFinite()) continue;
    agree = agree && (root_depth == 0 || same_position(root, placed, size));
    if (root_depth != 0 && node.depth >= root_depth) continue;
    root = placed;
    root_depth = node.depth;
  }
  if (root_depth == 0) return node_to_world;
  if (agree) return root;
  return merely_posed(root, node_to_world) ? node_to_world : root;
}

}  // namespace bodice::io
