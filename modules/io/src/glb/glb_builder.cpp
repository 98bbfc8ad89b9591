// Based on: Khronos Group. glTF 2.0 Specification. 2021. - sections 3.6 (buffers and accessors), 4.4 (GLB)
#include "glb_builder.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <numeric>
#include <string_view>

#include "../glb_chunks.hpp"

namespace bodice::inline v0_1::io {

namespace {

static_assert(std::endian::native == std::endian::little, "GLB is little-endian: swap bytes on this machine");
static_assert(sizeof(Vec3f) == 12 && sizeof(geometry::Triangle) == 12);

constexpr int kFloat = 5126, kUnsignedInt = 5125, kUnsignedShort = 5123, kShort = 5122, kByte = 5120;
constexpr int kArrayBuffer = 34962, kElementArrayBuffer = 34963, kNoTarget = 0;

void append_u32(std::string& bytes, std::uint32_t value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

void pad_to_four(std::string& bytes, char with) {
  while (bytes.size() % 4 != 0) bytes.push_back(with);
}

std::size_t components_of(std::string_view type) {
  if (type == "MAT4") return 16;
  return type == "VEC4" ? 4 : type == "VEC3" ? 3 : type == "VEC2" ? 2 : 1;
}

Json to_json(const Vec3f& v) {
  return {v.x(), v.y(), v.z()};
}

}  // namespace

GlbBuilder::GlbBuilder() {
  document_["asset"] = {{"version", "2.0"}, {"generator", "bodice"}};
  document_["scene"] = 0;
  document_["scenes"] = Json::array({Json{{"nodes", Json::array()}}});
}

std::size_t GlbBuilder::add(const char* array, Json value) {
  Json& list = document_[array];
  list.push_back(std::move(value));
  return list.size() - 1;
}

void GlbBuilder::add_to_scene(std::size_t node) {
  document_["scenes"][0]["nodes"].push_back(node);
}

std::size_t GlbBuilder::add_view(const void* data, std::size_t bytes, int target) {
  Json view = {{"buffer", 0}, {"byteOffset", buffer_.size()}, {"byteLength", bytes}};
  if (target != kNoTarget) view["target"] = target;
  buffer_.append(static_cast<const char*>(data), bytes);
  pad_to_four(buffer_, '\0');
  return add("bufferViews", std::move(view));
}

std::size_t GlbBuilder::add_accessor(std::size_t view, int component, std::size_t count, const char* type) {
  return add("accessors",
             {{"bufferView", view}, {"componentType", component}, {"count", count}, {"type", type}});
}

std::size_t GlbBuilder::add_positions(std::span<const Vec3f> values) {
  const std::size_t accessor = add_vectors(values);
  Vec3f low = Vec3f::Constant(std::numeric_limits<float>::max()), high = -low;
  for (const Vec3f& v : values) low = low.cwiseMin(v), high = high.cwiseMax(v);
  document_["accessors"][accessor]["min"] = to_json(low);
  document_["accessors"][accessor]["max"] = to_json(high);
  return accessor;
}

std::size_t GlbBuilder::add_vectors(std::span<const Vec3f> values) {
  return add_accessor(add_view(values.data(), values.size_bytes(), kArrayBuffer), kFloat, values.size(),
                      "VEC3");
}

std::size_t GlbBuilder::add_triangles(std::span<const geometry::Triangle> triangles) {
  return add_accessor(add_view(triangles.data(), triangles.size_bytes(), kElementArrayBuffer), kUnsignedInt,
                      3 * triangles.size(), "SCALAR");
}

std::size_t GlbBuilder::add_times(std::span<const float> seconds) {
  const std::size_t accessor = add_scalars(seconds);
  const auto [low, high] = std::minmax_element(seconds.begin(), seconds.end());
  document_["accessors"][accessor]["min"] = {*low};
  document_["accessors"][accessor]["max"] = {*high};
  return accessor;
}

std::size_t GlbBuilder::add_scalars(std::span<const float> values) {
  return add_accessor(add_view(values.data(), values.size_bytes(), kNoTarget), kFloat, values.size(),
                      "SCALAR");
}

std::size_t GlbBuilder::add_joints(std::span<const std::uint16_t> values) {
  return add_accessor(add_view(values.data(), values.size_bytes(), kArrayBuffer), kUnsignedShort,
                      values.size() / 4, "VEC4");
}

std::size_t GlbBuilder::add_weights(std::span<const float> values) {
  return add_accessor(add_view(values.data(), values.size_bytes(), kArrayBuffer), kFloat, values.size() / 4,
                      "VEC4");
}

std::size_t GlbBuilder::add_values(std::span<const float> values, const char* type) {
  return add_accessor(add_view(values.data(), values.size_bytes(), kNoTarget), kFloat,
                      values.size() / components_of(type), type);
}

std::size_t GlbBuilder::add_attribute(std::span<const float> values, const char* type) {
  return add_accessor(add_view(values.data(), values.size_bytes(), kArrayBuffer), kFloat,
                      values.size() / components_of(type), type);
}

std::size_t GlbBuilder::add_ones(std::span<const std::uint32_t> at, std::size_t count) {
  const std::vector<float> ones(at.size(), 1.0f);
  const std::size_t indices = add_view(at.data(), at.size_bytes(), kNoTarget);
  const std::size_t values = add_view(ones.data(), sizeof(float) * ones.size(), kNoTarget);
  return add("accessors", {{"componentType", kFloat},
                           {"count", count},
                           {"type", "SCALAR"},
                           {"sparse",
                            {{"count", at.size()},
                             {"indices", {{"bufferView", indices}, {"componentType", kUnsignedInt}}},
                             {"values", {{"bufferView", values}}}}}});
}

std::size_t GlbBuilder::add_image_bytes(std::string_view bytes) {
  return add_view(bytes.data(), bytes.size(), kNoTarget);
}

void GlbBuilder::name_in(const char* list, std::string_view extension) {
  Json& names = document_[list];
  if (std::find(names.begin(), names.end(), extension) == names.end()) names.push_back(extension);
}

void GlbBuilder::require(std::string_view extension) {
  use(extension);
  name_in("extensionsRequired", extension);
}

void GlbBuilder::use(std::string_view extension) {
  name_in("extensionsUsed", extension);
}

std::size_t GlbBuilder::size(const char* array) const {
  return document_.contains(array) ? document_[array].size() : 0;
}

std::string GlbBuilder::finish() const {
  Json document = document_;
  document["buffers"] = Json::array({Json{{"byteLength", buffer_.size()}}});
  std::string text = document.dump({.replaces_invalid = true});  // names need not be UTF-8
  pad_to_four(text, ' ');
  const std::size_t length = 12 + 8 + text.size() + 8 + buffer_.size();
  if (length > std::numeric_limits<std::uint32_t>::max()) return {};

  std::string file;
  file.reserve(length);
  for (const std::uint32_t value : {kGlbMagic, kGlbVersion, static_cast<std::uint32_t>(length)})
    append_u32(file, value);
  append_u32(file, static_cast<std::uint32_t>(text.size()));
  append_u32(file, kGlbJsonChunk);
  file += text;
  append_u32(file, static_cast<std::uint32_t>(buffer_.size()));
  append_u32(file, kGlbBinaryChunk);
  file += buffer_;
  return file;
}

std::size_t GlbSparseWriter::add(std::span<const std::array<std::int16_t, 3>> values) {
  return add_values(values, kShort);
}

std::size_t GlbSparseWriter::add(std::span<const std::array<std::int8_t, 3>> values) {
  return add_values(values, kByte);
}

/// The indices take two bytes where they can.
Json GlbSparseWriter::indices_of(std::span<const std::uint32_t> listed) {
  if (elements_ > std::numeric_limits<std::uint16_t>::max())
    return {{"bufferView", glb_.add_view(listed.data(), listed.size_bytes(), kNoTarget)},
            {"componentType", kUnsignedInt}};
  const std::vector<std::uint16_t> small(listed.begin(), listed.end());
  return {{"bufferView", glb_.add_view(small.data(), 2 * small.size(), kNoTarget)},
          {"componentType", kUnsignedShort}};
}

namespace {

/// An accessor of integers that stand for -1 to 1, with its bounds and no data yet.
template <class T>
Json small_accessor(std::span<const std::array<T, 3>> values, int component) {
  std::array<T, 3> low = values.front(), high = low;
  for (const std::array<T, 3>& value : values)
    for (std::size_t k = 0; k < 3; ++k)
      low[k] = std::min(low[k], value[k]), high[k] = std::max(high[k], value[k]);
  return {{"componentType", component},
          {"normalized", true},
          {"count", values.size()},
          {"type", "VEC3"},
          {"min", low},
          {"max", high}};
}

}  // namespace

template <class T>
std::size_t GlbSparseWriter::add_values(std::span<const std::array<T, 3>> values, int component) {
  using Value = std::array<T, 3>;
  Json accessor = small_accessor(values, component);
  std::vector<std::uint32_t> moved;
  for (std::size_t i = 0; i < elements_; ++i)
    if (values[i] != Value{}) moved.push_back(static_cast<std::uint32_t>(i));
  if (moved.empty()) return glb_.add("accessors", std::move(accessor));
  const std::size_t index_bytes = elements_ > std::numeric_limits<std::uint16_t>::max() ? 4 : 2;
  const bool all = moved.size() * (sizeof(Value) + index_bytes) >= elements_ * sizeof(Value);
  if (all && of_all_.is_null()) {
    std::vector<std::uint32_t> every(elements_);
    std::iota(every.begin(), every.end(), 0u);
    of_all_ = indices_of(every);
  }
  std::vector<Value> packed;
  for (const std::uint32_t i : moved) packed.push_back(values[i]);
  const std::span<const Value> listed = all ? values : std::span<const Value>(packed);
  accessor["sparse"] = {
      {"count", listed.size()},
      {"indices", all ? of_all_ : indices_of(moved)},
      {"values", {{"bufferView", glb_.add_view(listed.data(), listed.size_bytes(), kNoTarget)}}}};
  return glb_.add("accessors", std::move(accessor));
}

}  // namespace bodice::io
