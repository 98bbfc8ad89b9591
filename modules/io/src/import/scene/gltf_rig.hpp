// What a glTF document holds of a rig: bones with all their weights, clips with their interpolation.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "import/scene/scene_rig.hpp"
#include "import/source/gltf_document.hpp"

namespace bodice::inline v0_1::io {

/// A glTF document beside the scene that assimp made of it.
class GltfRig {
 public:
  /// Empty where the scene's nodes are not those of the document.
  static std::optional<GltfRig> match(GltfDocument document, const SceneNodes& nodes);

  /// The bones of primitive number `primitive` of the mesh at a node of the scene; none if it is not skinned.
  std::vector<FileBone> bones(std::uint32_t scene_node, std::size_t primitive) const;
  std::vector<FileClip> clips() const;

  const GltfDocument& document() const { return document_; }
  /// The document's node of a node of the scene; null where there is none.
  const engine::SortedJson& node(std::uint32_t scene_node) const;
  /// Primitive number `primitive` of the mesh at a node of the scene; null where there is none.
  const engine::SortedJson& primitive(std::uint32_t scene_node, std::size_t primitive) const;

 private:
  bool walk(std::size_t document_node, const aiNode& node, const SceneNodes& nodes);
  std::vector<FileBone> bones_of_skin(const engine::SortedJson& skin) const;
  void add_track(const engine::SortedJson& channel, const engine::SortedJson& animation,
                 FileClip& clip) const;

  static constexpr std::size_t kNone = ~std::size_t{0};
  static constexpr std::uint32_t kNoNode = ~std::uint32_t{0};

  GltfDocument document_;
  std::vector<std::size_t> document_node_;  // of each scene node, or kNone
  std::vector<std::uint32_t> scene_node_;   // of each document node, or kNoNode
};

}  // namespace bodice::io
