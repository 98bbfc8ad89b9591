// Materials and texture coordinates of a glTF document, as they are.
#pragma once

#include <filesystem>
#include <vector>

#include "import/look/mesh_look.hpp"
#include "import/source/gltf_document.hpp"

namespace bodice::inline v0_1::io {

/// Takes materials of a document one by one, each once and with all that it refers to.
class GltfLook {
 public:
  /// `folder` holds the images that the document names. Both must outlive this.
  GltfLook(const GltfDocument& document, const std::filesystem::path& folder, FileLook& out);

  /// The number in `out` of a material of the document; kNoMaterial where it does not exist.
  std::uint32_t material(std::size_t index);
  /// Reads all texture coordinates of a primitive with these triangles.
  void read_uv(const engine::SortedJson& primitive, std::size_t vertices,
               std::span<const geometry::Triangle> triangles, MeshLook& look) const;

 private:
  std::optional<std::size_t> texture(std::size_t index);
  std::optional<std::size_t> image(std::size_t index, bool core);
  std::size_t sampler(std::size_t index);
  /// Lists the extensions of an object that the document requires.
  void note_required(const engine::SortedJson& object);

  static constexpr std::size_t kUnread = ~std::size_t{0}, kNone = kUnread - 1;

  const GltfDocument& document_;
  const std::filesystem::path& folder_;
  FileLook& out_;
  std::vector<std::size_t> materials_, textures_, samplers_,
      images_;  // numbers in out_, for those of the document
};

}  // namespace bodice::io
