#pragma once

#include <span>

#include <assimp/scene.h>
#include <Eigen/Core>

#include "import/scene/file_rig.hpp"

namespace bodice::inline v0_1::io {

/// The matrix that takes a mesh to the world. `node_to_world` is its node's; a skinned mesh follows its bones
/// where they agree on the bind pose.
Eigen::Matrix4d mesh_to_world(std::span<const FileBone> bones, std::span<const FileNode> nodes,
                              const aiMesh& mesh, const Eigen::Matrix4d& node_to_world);

Eigen::Matrix4d to_eigen(const aiMatrix4x4& matrix);

}  // namespace bodice::io
