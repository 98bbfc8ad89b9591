// Bodies that are skinned to a skeleton, read from GLB.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <bodice/geometry/tri_mesh.hpp>

namespace bench {

struct Bone {
  std::string name;
  int parent = -1;              ///< position in the list, before the bone's own
  bodice::geometry::Vec3 head;  ///< in the rest pose, meters
};

/// Four bones a vertex and what each counts.
struct Influence {
  std::array<std::size_t, 4> bone;
  std::array<double, 4> weight;
};

struct Rig {
  bodice::geometry::TriMesh rest;
  std::vector<Bone> bones;
  std::vector<Influence> influences;  ///< #V
};

/// A minimal reader: the mesh `body` with a skin that turns no bone in the rest pose. Throws what the
/// JSON reader does on another file.
Rig read_rig(const std::filesystem::path& glb);

/// The same skeleton in another body of the same topology: a joint keeps its position among the skin that its
/// two bones share.
Rig moved_into(const Rig& rig, const bodice::geometry::TriMesh& rest);

/// Where each bone's points go when it is turned about its head against its parent: one turn a bone.
std::vector<Eigen::Affine3d> pose_bones(const Rig& rig, const std::vector<Eigen::Quaterniond>& turns);

/// Linear blend skinning.
bodice::geometry::TriMesh pose_skin(const Rig& rig, const std::vector<Eigen::Affine3d>& bones);

}  // namespace bench
