#include "import/source/check_gltf.hpp"

#include <algorithm>
#include <string>

namespace bodice::inline v0_1::io {

namespace {

using engine::SortedJson;

engine::Error broken(const std::filesystem::path& file, const std::string& what, const char* remedy) {
  return {engine::ErrorCode::kUnreadable, "'" + file.string() + "': " + what, remedy};
}

/// "The skin 2 ('body')".
std::string label(const char* kind, std::size_t index, const SortedJson& element) {
  std::string name = text_at(element, "name").substr(0, 60);
  for (char& c : name)
    if (static_cast<unsigned char>(c) < 32 || static_cast<unsigned char>(c) > 126) c = '?';
  return std::string("The ") + kind + " " + std::to_string(index) + (name.empty() ? "" : " ('" + name + "')");
}

/// The number of elements of an accessor that can be read, 0 if it cannot.
std::size_t count_of(const GltfDocument& document, const SortedJson& object, const char* key,
                     std::size_t components) {
  const auto at = index_at(object, key);
  const auto numbers = at ? document.numbers(*at) : std::nullopt;
  return numbers && numbers->components == components ? numbers->count : 0;
}

bool floats(const GltfDocument& document, const SortedJson& object, const char* key) {
  const auto at = index_at(object, key);
  return at && index_at(document.element("accessors", *at), "componentType") == std::size_t{5126};
}

bool has_weights(const GltfDocument& document, const SortedJson& primitive) {
  if (!primitive.is_object() || !primitive.contains("attributes")) return true;
  const SortedJson& attributes = primitive["attributes"];
  if (!attributes.is_object() || (!attributes.contains("JOINTS_0") && !attributes.contains("WEIGHTS_0")))
    return true;
  const std::size_t vertices = count_of(document, attributes, "POSITION", 3);
  return vertices > 0 && count_of(document, attributes, "JOINTS_0", 4) == vertices &&
         count_of(document, attributes, "WEIGHTS_0", 4) == vertices;
}

bool has_values(const GltfDocument& document, const SortedJson& sampler) {
  const std::size_t times = count_of(document, sampler, "input", 1);
  const auto output = index_at(sampler, "output");
  const auto values = output ? document.numbers(*output) : std::nullopt;
  const std::size_t per_key = text_at(sampler, "interpolation") == "CUBICSPLINE" ? 3 : 1;
  return times > 0 && values && values->count >= per_key * times;
}

}  // namespace

engine::Result<void> check_gltf(const GltfDocument& document, const std::filesystem::path& file) {
  const SortedJson& skins = array_at(document.root(), "skins");
  for (std::size_t i = 0; i < skins.size(); ++i)
    if (!floats(document, skins[i], "inverseBindMatrices") ||
        count_of(document, skins[i], "inverseBindMatrices", 16) < array_at(skins[i], "joints").size())
      return broken(file, label("skin", i, skins[i]) + " lacks inverse bind matrices for its joints.",
                    "Export it with its bind pose (inverseBindMatrices).");
  const SortedJson& meshes = array_at(document.root(), "meshes");
  for (std::size_t i = 0; i < meshes.size(); ++i)
    for (const SortedJson& primitive : array_at(meshes[i], "primitives"))
      if (!has_weights(document, primitive))
        return broken(file,
                      label("mesh", i, meshes[i]) + " has skin weights that are not there for each vertex.",
                      "Export it again with one set of joints and weights a vertex.");
  const SortedJson& animations = array_at(document.root(), "animations");
  for (std::size_t i = 0; i < animations.size(); ++i)
    for (const SortedJson& sampler : array_at(animations[i], "samplers"))
      if (!has_values(document, sampler))
        return broken(file, label("animation", i, animations[i]) + " has keys without values.",
                      "Export it again, or without that animation.");
  return {};
}

}  // namespace bodice::io
