// Bodies that are skinned to a skeleton, read from files.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <bodice/geometry/tri_mesh.hpp>
#include <bodice/rig/skinning.hpp>

namespace bench {

struct Bone {
  std::string name;
  int parent = -1;              ///< position in the list, before the bone's own
  bodice::geometry::Vec3 head;  ///< in the rest pose, meters
};

struct Rig {
  bodice::geometry::TriMesh rest;    ///< vertices in the order of the file, to which labels refer
  std::vector<Bone> bones;           ///< one a joint of the weights
  bodice::rig::SkinWeights weights;  ///< #V
};

/// The mesh `body` of a file with its skeleton, in its bind pose. Throws std::runtime_error, with the
/// importer's sentence or where welding joined vertices of the file.
Rig read_rig(const std::filesystem::path& file);

/// The same skeleton in another body of the same topology: a joint keeps its position among the skin that its
/// two bones share.
Rig moved_into(const Rig& rig, const bodice::geometry::TriMesh& rest);

/// Where each bone's points go when it is turned about its head against its parent: one turn a bone.
std::vector<Eigen::Affine3d> pose_bones(const Rig& rig, const std::vector<Eigen::Quaterniond>& turns);

/// Linear blend skinning.
bodice::geometry::TriMesh pose_skin(const Rig& rig, const std::vector<Eigen::Affine3d>& bones);

}  // namespace bench
