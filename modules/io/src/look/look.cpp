// Based on: Khronos Group. glTF 2.0 Specification. 2021. - sections 3.8 (images, textures), 3.9 (materials)
#include "look/look.hpp"

#include <algorithm>

#include <bodice/io/scene.hpp>

namespace bodice::inline v0_1::io {

namespace {

using engine::SortedJson;

/// Objects of real materials are at most four deep.
constexpr int kMostDepth = 16;

void renumber_textures_in(SortedJson& object,
                          const std::function<std::optional<std::size_t>(std::size_t)>& renumber, int depth) {
  if (!object.is_object() || depth > kMostDepth) return;
  object.erase_if([&](SortedJson::Member& member) {
    if (member.key.ends_with("Texture") && member.value.contains("index")) {
      SortedJson& index = member.value["index"];
      const auto now = index.is_number_unsigned() ? renumber(index.get<std::size_t>()) : std::nullopt;
      if (!now) return true;
      index = *now;
    }
    renumber_textures_in(member.value, renumber, depth + 1);
    return false;
  });
}

}  // namespace

void renumber_textures(SortedJson& material,
                       const std::function<std::optional<std::size_t>(std::size_t)>& renumber) {
  renumber_textures_in(material, renumber, 0);
}

bool renumber_images(SortedJson& texture,
                     const std::function<std::optional<std::size_t>(std::size_t, bool)>& renumber) {
  bool left = false;
  const auto visit = [&](SortedJson& holder, bool core) {
    SortedJson* const source = holder.find("source");
    if (!source) return;
    const auto now = source->is_number_unsigned() ? renumber(source->get<std::size_t>(), core) : std::nullopt;
    left = left || now;
    if (now)
      *source = *now;
    else
      holder.erase("source");
  };
  if (!texture.is_object()) return false;
  visit(texture, true);
  SortedJson* const extensions = texture.find("extensions");
  if (!extensions || !extensions->is_object()) return left;
  extensions->erase_if([&](SortedJson::Member& extension) {
    if (extension.value.is_object()) visit(extension.value, false);
    return extension.value.empty();
  });
  if (extensions->empty()) texture.erase("extensions");
  return left;
}

void collect_extensions(const SortedJson& object, std::vector<std::string>& names) {
  std::vector<const SortedJson*> waiting{&object};
  while (!waiting.empty()) {
    const SortedJson& now = *waiting.back();
    waiting.pop_back();
    if (!now.is_object()) continue;
    for (const auto& [key, value] : now.items()) {
      if (key == "extensions" && value.is_object())
        for (const auto& extension : value.items()) names.push_back(extension.key);
      waiting.push_back(&value);
    }
  }
  std::ranges::sort(names);
  names.erase(std::unique(names.begin(), names.end()), names.end());
}

std::string_view image_type(std::string_view bytes) {
  using namespace std::string_view_literals;
  if (bytes.starts_with("\x89PNG\r\n\x1a\n"sv)) return "image/png";
  if (bytes.starts_with("\xff\xd8\xff"sv)) return "image/jpeg";
  if (bytes.starts_with("RIFF"sv) && bytes.substr(0, 12).ends_with("WEBP"sv)) return "image/webp";
  if (bytes.starts_with("\xabKTX 20\xbb"sv)) return "image/ktx2";
  return "";
}

bool is_core_image(std::string_view mime_type) {
  return mime_type == "image/png" || mime_type == "image/jpeg";
}

}  // namespace bodice::io
