// Based on: Khronos Group. glTF 2.0 Specification. 2021. - sections 3.8 (images, textures), 3.9 (materials)
#include "import/look/gltf_look.hpp"

#include <algorithm>
#include <cmath>

#include <bodice/engine/message.hpp>

#include "import/source/gltf_buffers.hpp"

namespace bodice::inline v0_1::io {

using engine::SortedJson;

GltfLook::GltfLook(const GltfDocument& document, const std::filesystem::path& folder, FileLook& out)
    : document_(document), folder_(folder), out_(out) {
  const auto unread = [&](const char* array) {
    return std::vector<std::size_t>(array_at(document.root(), array).size(), kUnread);
  };
  materials_ = unread("materials"), textures_ = unread("textures");
  samplers_ = unread("samplers"), images_ = unread("images");
}

std::uint32_t GltfLook::material(std::size_t index) {
  if (index >= materials_.size() || !document_.element("materials", index).is_object()) return kNoMaterial;
  if (materials_[index] != kUnread) return static_cast<std::uint32_t>(materials_[index]);
  SortedJson copy = document_.element("materials", index);
  renumber_textures(copy, [&](std::size_t texture_index) { return texture(texture_index); });
  // A packet of metadata stands elsewhere in the document.
  if (copy.contains("extensions") && copy["extensions"].is_object())
    copy["extensions"].erase("KHR_xmp_json_ld");
  note_required(copy);
  materials_[index] = out_.materials.materials.size();
  out_.materials.materials.push_back(std::move(copy));
  return static_cast<std::uint32_t>(materials_[index]);
}

void GltfLook::note_required(const SortedJson& object) {
  std::vector<std::string> names;
  collect_extensions(object, names);
  for (const SortedJson& required : array_at(document_.root(), "extensionsRequired"))
    if (required.is_string() && std::ranges::find(names, required.get<std::string>()) != names.end())
      out_.materials.required.push_back(required.get<std::string>());
}

std::optional<std::size_t> GltfLook::texture(std::size_t index) {
  if (index >= textures_.size()) return std::nullopt;
  std::size_t& known = textures_[index];
  if (known == kUnread) {
    known = kNone;
    SortedJson copy = document_.element("textures", index);
    if (renumber_images(copy, [&](std::size_t at, bool core) { return image(at, core); })) {
      if (const auto at = index_at(copy, "sampler"); at && *at < samplers_.size())
        copy["sampler"] = sampler(*at);
      else
        copy.erase("sampler");
      note_required(copy);
      known = out_.materials.textures.size();
      out_.materials.textures.push_back(std::move(copy));
    }
  }
  return known == kNone ? std::nullopt : std::optional(known);
}

std::size_t GltfLook::sampler(std::size_t index) {
  if (samplers_[index] == kUnread) {
    samplers_[index] = out_.materials.samplers.size();
    const SortedJson& original = document_.element("samplers", index);
    out_.materials.samplers.push_back(original.is_object() ? original : SortedJson::object());
  }
  return samplers_[index];
}

std::optional<std::size_t> GltfLook::image(std::size_t index, bool core) {
  if (index >= images_.size()) return std::nullopt;
  std::size_t& known = images_[index];
  if (known == kUnread) {
    known = kNone;
    const SortedJson& object = document_.element("images", index);
    const std::string uri = text_at(object, "uri");
    LookImage image{text_at(object, "name"), {}, {}};
    if (const auto view = index_at(object, "bufferView"))
      image.bytes = document_.view_bytes(*view);
    else
      image.bytes = load_uri(uri, folder_);
    image.mime_type = image_type(image.bytes);
    if (image.mime_type.empty()) {
      const std::string shown = uri.empty() || uri.starts_with("data:") ? image.name : uri;
      out_.warnings.push_back(
          {"image-left-out", shown,
           engine::message("Image ", index, " of the garment's materials",
                           shown.empty() ? "" : " ('" + shown + "')", " is missing or of an unknown kind."),
           "Put it where the file names it, as PNG or JPEG."});
    } else {
      known = out_.materials.images.size();
      out_.materials.images.push_back(std::move(image));
    }
  }
  if (known == kNone || (core && !is_core_image(out_.materials.images[known].mime_type))) return std::nullopt;
  return known;
}

void GltfLook::read_uv(const SortedJson& primitive, std::size_t vertices,
                       std::span<const geometry::Triangle> triangles, MeshLook& look) const {
  const SortedJson* attributes = primitive.find("attributes");
  if (!attributes) return;
  std::vector<GltfNumbers> sets;
  for (;;) {
    const auto at = index_at(*attributes, ("TEXCOORD_" + std::to_string(sets.size())).c_str());
    auto numbers = at ? document_.numbers(*at) : std::nullopt;
    if (!numbers || numbers->components != 2 || numbers->count != vertices) break;
    sets.push_back(std::move(*numbers));
  }
  look.uv_sets = sets.size();
  for (const geometry::Triangle& triangle : triangles)
    for (const geometry::Index v : triangle)
      for (const GltfNumbers& set : sets)
        for (std::size_t k = 0; k < 2; ++k) {
          const auto value = static_cast<float>(set.values[2 * v + k]);
          look.uv.push_back(std::isfinite(value) ? value : 0.0f);
        }
}

}  // namespace bodice::io
