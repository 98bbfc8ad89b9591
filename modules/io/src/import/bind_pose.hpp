#pragma once

#include <assimp/scene.h>
#include <Eigen/Core>

namespace bodice::io {

/// Where a mesh stands in the world, 4x4. `node_to_world` is its node's; a skinned mesh is placed by its
/// bones where they agree on the bind pose.
Eigen::Matrix4d mesh_to_world(const aiScene& scene, const aiMesh& mesh, const Eigen::Matrix4d& node_to_world);

Eigen::Matrix4d to_eigen(const aiMatrix4x4& matrix);

}  // namespace bodice::io
