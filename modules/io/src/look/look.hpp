// How a garment looks in its file: its name, materials, images and texture coordinates.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <bodice/engine/json.hpp>

namespace bodice::inline v0_1::io {

inline constexpr std::uint32_t kNoMaterial = std::numeric_limits<std::uint32_t>::max();

/// An image as its file has it.
struct LookImage {
  std::string name, mime_type, bytes;
};

/// Materials in the words of glTF. Their numbers of textures, samplers and images count in these lists.
struct Materials {
  std::vector<engine::SortedJson> materials, textures, samplers;
  std::vector<LookImage> images;
  std::vector<std::string> required;  ///< extensions of glTF that a reader must support
};

/// The look of a garment. `uv` and `material` belong to the triangles of the mesh that import_garment() gave.
struct Look {
  std::string name;  ///< of the garment's nodes; empty where the file has none
  Materials materials;
  std::size_t uv_sets = 0;
  std::vector<float> uv;                ///< #F x 3 x uv_sets x 2; v grows downward, as in glTF
  std::vector<std::uint32_t> material;  ///< #F, into `materials`, or kNoMaterial
};

/// Replaces the number of each texture that a material refers to. Where `renumber` gives none, the reference
/// is dropped. By glTF's rule the key of a reference ends with "Texture", in extensions as well.
void renumber_textures(engine::SortedJson& material,
                       const std::function<std::optional<std::size_t>(std::size_t)>& renumber);

/// Replaces the number of each image that a texture refers to. Where `renumber` gives none, the reference is
/// dropped; its second argument is whether the image belongs to the core of glTF and not to an extension.
/// Returns whether a reference is left.
bool renumber_images(engine::SortedJson& texture,
                     const std::function<std::optional<std::size_t>(std::size_t, bool)>& renumber);

/// The names of all extensions in an object.
void collect_extensions(const engine::SortedJson& object, std::vector<std::string>& names);

/// The MIME type of an image by its first bytes: PNG, JPEG, WebP or KTX2; empty for anything else.
std::string_view image_type(std::string_view bytes);
/// Whether the core of glTF has images of this type: PNG and JPEG.
bool is_core_image(std::string_view mime_type);

}  // namespace bodice::io
