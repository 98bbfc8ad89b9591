// The nodes of a glTF document: parents, and transforms to the world.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include <Eigen/Geometry>

#include <bodice/rig/skeleton.hpp>

#include "import/source/gltf_document.hpp"

namespace bodice::inline v0_1::io {

class NodeTree {
 public:
  /// Nodes that are their own ancestors count as roots.
  explicit NodeTree(const GltfDocument& document);

  std::size_t size() const { return local_.size(); }
  /// The first node of a name at the top of the scene or right below the node `input`, one with a mesh before
  /// others: joints and garments may have the same name.
  std::optional<std::size_t> find_top(std::string_view name) const;
  /// kNoParent for a root.
  std::ptrdiff_t parent(std::size_t node) const { return parent_[node]; }
  const rig::LocalTransform& local(std::size_t node) const { return local_[node]; }
  /// The node's coordinates to the world's.
  Eigen::Affine3d world(std::size_t node) const;
  /// The same with another local transform.
  Eigen::Affine3d world_with(std::size_t node, const rig::LocalTransform& local) const;

  static constexpr std::ptrdiff_t kNoParent = -1;

 private:
  bool is_top(std::size_t node) const;

  const GltfDocument& document_;
  std::vector<rig::LocalTransform> local_;
  std::vector<std::ptrdiff_t> parent_;
};

}  // namespace bodice::io
