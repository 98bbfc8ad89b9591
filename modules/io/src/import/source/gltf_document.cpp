// Based on: Khronos Group. glTF 2.0 Specification. 2021. - sections 3.6 (buffers, accessors), 4.4 (GLB)
#include "import/source/gltf_document.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

#include "import/source/gltf_buffers.hpp"
#include "import/source/input_file.hpp"

namespace bodice::inline v0_1::io {

namespace {

using engine::SortedJson;

const SortedJson kNothing;
const SortedJson kEmptyArray = SortedJson::array();

/// An accessor without data is all zeros; more of them than this is hostile.
constexpr std::size_t kMostZeros = std::size_t{1} << 26;

std::size_t components_of(const std::string& type) {
  constexpr std::pair<const char*, std::size_t> kTypes[] = {
      {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT2", 4}, {"MAT3", 9}, {"MAT4", 16}};
  for (const auto& [name, components] : kTypes)
    if (type == name) return components;
  return 0;
}

std::size_t bytes_of(std::size_t component_type) {
  switch (component_type) {
    case 5120:
    case 5121:
      return 1;
    case 5122:
    case 5123:
      return 2;
    case 5125:
    case 5126:
      return 4;
    default:
      return 0;
  }
}

template <class T>
double load(const char* at) {
  T value;
  std::memcpy(&value, at, sizeof value);
  return static_cast<double>(value);
}

double load(const char* at, std::size_t component_type, bool normalized) {
  switch (component_type) {
    case 5120:
      return normalized ? std::max(load<std::int8_t>(at) / 127.0, -1.0) : load<std::int8_t>(at);
    case 5121:
      return load<std::uint8_t>(at) / (normalized ? 255.0 : 1.0);
    case 5122:
      return normalized ? std::max(load<std::int16_t>(at) / 32767.0, -1.0) : load<std::int16_t>(at);
    case 5123:
      return load<std::uint16_t>(at) / (normalized ? 65535.0 : 1.0);
    case 5125:
      return load<std::uint32_t>(at);
    default:
      return load<float>(at);
  }
}

}  // namespace

/// How the elements of an accessor lie in memory.
struct GltfDocument::Layout {
  std::size_t component_type = 0, components = 0, count = 0;
  bool normalized = false;

  std::size_t element_bytes() const { return components * bytes_of(component_type); }
};

std::optional<std::size_t> index_at(const SortedJson& object, const char* key) {
  if (!object.is_object()) return std::nullopt;
  const SortedJson* found = object.find(key);
  if (!found || !found->is_number_unsigned()) return std::nullopt;
  return found->get<std::size_t>();
}

std::string text_at(const SortedJson& object, const char* key) {
  if (!object.is_object()) return "";
  const SortedJson* found = object.find(key);
  return !found || !found->is_string() ? "" : found->get<std::string>();
}

const SortedJson& array_at(const SortedJson& object, const char* key) {
  if (!object.is_object()) return kEmptyArray;
  const SortedJson* found = object.find(key);
  return !found || !found->is_array() ? kEmptyArray : *found;
}

std::optional<GltfDocument> GltfDocument::open(const std::filesystem::path& file) {
  GltfDocument document;
  const GltfText text = split_glb(read_text(file));
  document.json_ = SortedJson::parse_or_null(text.json);
  if (!document.json_.is_object() || !document.json_.contains("asset") ||
      !text_at(document.json_["asset"], "version").starts_with("2"))
    return std::nullopt;
  for (const SortedJson& buffer : array_at(document.json_, "buffers")) {
    const std::string uri = text_at(buffer, "uri");
    document.buffers_.push_back(uri.empty() ? std::string(text.binary) : load_uri(uri, file.parent_path()));
  }
  return document;
}

const SortedJson& GltfDocument::element(const char* array, std::size_t index) const {
  const SortedJson& list = array_at(json_, array);
  return index < list.size() ? list[index] : kNothing;
}

std::string_view GltfDocument::view_bytes(std::size_t view) const {
  const SortedJson& object = element("bufferViews", view);
  const auto buffer = index_at(object, "buffer"), length = index_at(object, "byteLength");
  const std::size_t offset = index_at(object, "byteOffset").value_or(0);
  if (!buffer || !length || *buffer >= buffers_.size()) return {};
  const std::string_view bytes = buffers_[*buffer];
  if (offset > bytes.size() || *length > bytes.size() - offset) return {};
  return bytes.substr(offset, *length);
}

bool GltfDocument::read_dense(const SortedJson& accessor, const Layout& layout, GltfNumbers& out) const {
  const auto view = index_at(accessor, "bufferView");
  if (!view) {
    if (layout.count > kMostZeros / layout.components) return false;
    out.values.assign(layout.count * layout.components, 0.0);
    return true;
  }
  const std::string_view bytes = view_bytes(*view);
  const std::size_t offset = index_at(accessor, "byteOffset").value_or(0), element = layout.element_bytes();
  const std::size_t stride =
      std::max(element, index_at(this->element("bufferViews", *view), "byteStride").value_or(0));
  if (layout.count == 0) return true;
  if (offset > bytes.size() || bytes.size() - offset < element ||
      (bytes.size() - offset - element) / stride < layout.count - 1)
    return false;
  out.values.reserve(layout.count * layout.components);
  for (std::size_t i = 0; i < layout.count; ++i)
    for (std::size_t k = 0; k < layout.components; ++k)
      out.values.push_back(load(bytes.data() + offset + i * stride + k * bytes_of(layout.component_type),
                                layout.component_type, layout.normalized));
  return true;
}

/// Replaces the elements that the accessor lists one by one.
bool GltfDocument::read_sparse(const SortedJson& accessor, const Layout& layout, GltfNumbers& out) const {
  if (!accessor.contains("sparse")) return true;
  const SortedJson& sparse = accessor["sparse"];
  if (!sparse.is_object() || !sparse.contains("indices") || !sparse.contains("values")) return false;
  const auto count = index_at(sparse, "count");
  const auto type = index_at(sparse["indices"], "componentType");
  GltfNumbers at, values;
  if (!count || !type || bytes_of(*type) == 0 || !index_at(sparse["indices"], "bufferView") ||
      !index_at(sparse["values"], "bufferView") ||
      !read_dense(sparse["indices"], {*type, 1, *count, false}, at) ||
      !read_dense(sparse["values"], {layout.component_type, layout.components, *count, layout.normalized},
                  values))
    return false;
  for (std::size_t i = 0; i < *count; ++i) {
    if (at.values[i] < 0.0 || at.values[i] >= static_cast<double>(layout.count)) return false;
    const auto from = values.values.begin() + static_cast<std::ptrdiff_t>(i * layout.components);
    std::copy_n(from, layout.components,
                out.values.begin() + static_cast<std::ptrdiff_t>(at.values[i]) *
                                         static_cast<std::ptrdiff_t>(layout.components));
  }
  return true;
}

std::optional<GltfNumbers> GltfDocument::numbers(std::size_t accessor) const {
  const SortedJson& object = element("accessors", accessor);
  const auto type = index_at(object, "componentType"), count = index_at(object, "count");
  if (!type || !count || bytes_of(*type) == 0) return std::nullopt;
  const SortedJson* normalized = object.find("normalized");
  const Layout layout{*type, components_of(text_at(object, "type")), *count,
                      normalized && normalized->is_boolean() && normalized->get<bool>()};
  GltfNumbers out{layout.count, layout.components, {}};
  if (layout.components == 0 || !read_dense(object, layout, out) || !read_sparse(object, layout, out))
    return std::nullopt;
  return out;
}

}  // namespace bodice::io
