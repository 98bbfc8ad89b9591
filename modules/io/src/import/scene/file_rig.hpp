// What a file holds of a rig before anything is judged: nodes, bones and clips in the file's own world
// coordinates.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <bodice/engine/result.hpp>
#include <bodice/geometry/types.hpp>
#include <bodice/rig/clip.hpp>

namespace bodice::inline v0_1::io {

struct FileNode {
  std::string name;
  std::int32_t parent = -1;                                ///< index of a node before this one; -1: the root
  int depth = 1;                                           ///< 1: the root
  Eigen::Matrix4d local = Eigen::Matrix4d::Identity();     ///< node to its parent
  Eigen::Matrix4d to_world = Eigen::Matrix4d::Identity();  ///< node to the file's world
  bool is_bone = false;                 ///< some mesh lists it as a bone, with weights or without
  std::vector<std::uint32_t> bindings;  ///< indices into FileRig::bindings
};

/// A node that a mesh is bound to, with its own bind pose: meshes of one file may differ in it.
struct FileBinding {
  std::uint32_t node = 0;
  Eigen::Matrix4d bind = Eigen::Matrix4d::Identity();  ///< node space to the skin's, both in file units
};

/// Per vertex, the bindings that move it: entries first[v] to first[v + 1] belong to vertex v. Empty where
/// the file has no bones.
struct FileWeights {
  std::vector<std::uint32_t> first, binding;
  std::vector<float> weight;
};

/// A bone of a mesh as its file lists it.
struct FileBone {
  std::uint32_t node = 0;
  Eigen::Matrix4d offset = Eigen::Matrix4d::Identity();  ///< mesh space to the bone's in the bind pose
  std::vector<std::pair<std::uint32_t, float>> weights;  ///< vertex, weight
};

struct FileClip {
  std::string name;
  double duration_s = 0.0;
  std::vector<std::pair<std::uint32_t, rig::Track>>
      tracks;        ///< node, its keys in file units (Track::joint unused)
  std::string flaw;  ///< what is wrong with it, a sentence; empty: nothing
};

struct FileRig {
  std::vector<FileNode> nodes;  ///< parents before children
  bool has_bones = false;       ///< some mesh of the file is skinned
  std::vector<FileBinding> bindings;
  std::vector<FileClip> clips;
  std::optional<engine::Error> flaw;  ///< what keeps the file from being a rig
  Eigen::Matrix4d world_to_file =
      Eigen::Matrix4d::Identity();  ///< of nodes to mesh coordinates: a uniform scale
};

/// Binds the vertices of a mesh (#V = `vertices`) that `mesh_to_world` stands in the world with. Without
/// bones, all of them follow `node`. Adds to the rig's bindings and bones, or sets its flaw.
FileWeights bind_mesh(std::span<const FileBone> bones, std::uint32_t node,
                      const Eigen::Matrix4d& mesh_to_world, std::size_t vertices, FileRig& rig);

/// The weights of some vertices, in their order.
FileWeights take_weights(const FileWeights& weights, std::span<const geometry::Index> vertices);
void append(const FileWeights& weights, FileWeights& to);

}  // namespace bodice::io
