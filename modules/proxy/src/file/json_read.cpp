#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <bodice/engine/json.hpp>
#include <bodice/proxy/proxy_file.hpp>

#include "binding/binding_bytes.hpp"
#include "file/json_form.hpp"

namespace bodice::inline v0_1::proxy {
namespace {

using engine::SortedJson;
using geometry::Frame;
using geometry::Vec3;

/// An Error that is thrown out of nested readers and caught in this file.
struct BadProxy {
  engine::Error error;
};

[[noreturn]] void fail(const std::string& where, const char* wanted) {
  throw BadProxy{{engine::ErrorCode::kUnreadable, "Proxy JSON: " + where + " is not " + wanted + ".",
                  "Write the file again with 'bodice fit', or correct this value."}};
}

const SortedJson& member(const SortedJson& object, const char* key, const std::string& where) {
  const SortedJson* found = object.find(key);
  if (!found) fail(where + key, "there");
  return *found;
}

double number(const SortedJson& value, const std::string& where) {
  if (!value.is_number()) fail(where, "a number");
  return value.get<double>();
}

double number(const SortedJson& object, const char* key, const std::string& where) {
  return number(member(object, key, where), where + key);
}

std::int64_t integer(const SortedJson& value, const std::string& where, std::int64_t least,
                     std::int64_t most) {
  if (!value.is_number_integer()) fail(where, "a whole number");
  const bool too_large = value.is_number_unsigned() && value.get<std::uint64_t>() > std::uint64_t(most);
  if (too_large || value.get<std::int64_t>() < least || value.get<std::int64_t>() > most)
    fail(where, "in range");
  return value.get<std::int64_t>();
}

std::string text(const SortedJson& object, const char* key, const std::string& where) {
  const SortedJson& value = member(object, key, where);
  if (!value.is_string()) fail(where + key, "text");
  return value.get<std::string>();
}

const SortedJson& list(const SortedJson& value, const std::string& where) {
  if (!value.is_array()) fail(where, "a list");
  return value;
}

Vec3 vector(const SortedJson& value, const std::string& where) {
  if (list(value, where).size() != 3) fail(where, "a list of three numbers");
  return {number(value[0], where), number(value[1], where), number(value[2], where)};
}

std::uint64_t hash_value(const SortedJson& object, const char* key) {
  const auto bytes = from_hex(text(object, key, ""));
  if (!bytes || bytes->size() != 8) fail(key, "16 hexadecimal digits");
  std::uint64_t value = 0;
  for (const std::byte byte : *bytes) value = value << 8 | std::to_integer<std::uint64_t>(byte);
  return value;
}

Frame read_frame(const SortedJson& root) {
  Frame frame;
  frame.meters_per_unit = number(root, "metres_per_unit", "");
  const std::string up = text(root, "up", "");
  for (std::size_t i = 0; i < kAxisNames.size(); ++i)
    if (kAxisNames[i] == up) {
      frame.up = static_cast<geometry::Axis>(i);
      return frame;
    }
  fail("up", "x, y or z");
}

ProxyEllipsoid read_ellipsoid(const SortedJson& value, const Frame& frame, const std::string& where) {
  if (!value.is_object()) fail(where, "an object");
  ProxyEllipsoid e;
  const auto part = body::part_from_name(text(value, "part", where));
  if (!part) fail(where + "part", "the name of a body part");
  e.part = *part;
  if (value.contains("bone"))
    e.bone = static_cast<std::int16_t>(integer(value["bone"], where + "bone", kNoBone, INT16_MAX));
  e.shape.center = frame.to_inside(vector(member(value, "center", where), where + "center"));
  e.shape.radii = frame.meters_per_unit * vector(member(value, "radii", where), where + "radii");
  const SortedJson& axes = list(member(value, "axes", where), where + "axes");
  if (axes.size() != 3) fail(where + "axes", "a list of three directions");
  for (int k = 0; k < 3; ++k) e.shape.axes.col(k) = frame.rotation() * vector(axes[k], where + "axes");
  return e;
}

ReliefTable read_table(const SortedJson& value, const Frame& frame, const std::string& where) {
  if (!value.is_object()) fail(where, "an object");
  auto length = [&](const char* key) {
    const double meters = number(value, key, where) * frame.meters_per_unit;
    if (!(std::abs(meters) <= 1e30)) fail(where + key, "a length");
    return static_cast<float>(meters);
  };
  ReliefTable t;
  t.nodes_per_side =
      static_cast<std::uint16_t>(integer(member(value, "nodes", where), where + "nodes", 0, kMaxReliefNodes));
  t.first_texel = static_cast<std::uint32_t>(
      integer(member(value, "first_texel", where), where + "first_texel", 0, UINT32_MAX));
  t.h_scale_m = length("h_scale");
  t.h_offset_m = length("h_offset");
  t.a_scale = length("a_scale");
  t.a_offset = length("a_offset");
  return t;
}

std::vector<ReliefTexel> read_texels(const std::string& hex) {
  const auto bytes = from_hex(hex);
  if (!bytes || bytes->size() % 2 != 0) fail("texels", "four hexadecimal digits a texel");
  std::vector<ReliefTexel> texels;
  texels.reserve(bytes->size() / 2);
  for (std::size_t i = 0; i < bytes->size(); i += 2)
    texels.push_back(
        {std::to_integer<std::uint8_t>((*bytes)[i]), std::to_integer<std::uint8_t>((*bytes)[i + 1])});
  return texels;
}

/// The line and column where the text stops being JSON, as an editor counts them.
std::string place_of(std::string_view source, std::size_t bytes_read) {
  std::string_view before = source.substr(0, bytes_read);
  if (before.ends_with('\n')) before.remove_suffix(1);
  const auto line = 1 + std::ranges::count(before, '\n');
  const std::size_t line_begin = before.rfind('\n') + 1;  // npos + 1 is 0
  return "line " + std::to_string(line) + ", column " + std::to_string(before.size() - line_begin);
}

SortedJson parse(std::string_view source) {
  try {
    return SortedJson::parse(source);
  } catch (const engine::JsonError& error) {
    if (error.kind == engine::JsonError::Kind::kNumberRange)
      fail("a number in it", "within the range of numbers");
    fail("the text up to " + place_of(source, error.byte), "JSON");
  }
}

void check_format(const SortedJson& root) {
  if (!root.is_object()) fail("the file", "a JSON object");
  if (text(root, "format", "") != kJsonFormat) fail("format", "bodice-proxy");
  const std::int64_t version =
      integer(member(root, "version", ""), "version", 0, std::numeric_limits<int>::max());
  if (version == kJsonVersion || version == kBoundJsonVersion) return;
  throw BadProxy{{engine::ErrorCode::kUnreadable,
                  "Proxy JSON: version " + std::to_string(version) + " is not known here.",
                  "This build reads versions " + std::to_string(kJsonVersion) + " and " +
                      std::to_string(kBoundJsonVersion) + "."}};
}

std::shared_ptr<const Binding> read_binding(const SortedJson& value) {
  if (!value.is_object()) fail("binding", "an object");
  const auto bytes = from_hex(text(value, "bytes", "binding."));
  if (!bytes) fail("binding.bytes", "hexadecimal");
  auto binding = std::make_shared<Binding>();
  ByteReader in(*bytes);
  if (!get_binding(in, *binding)) fail("binding.bytes", "a whole binding");
  return binding;
}

BodyProxy::Data read_data(const SortedJson& root) {
  BodyProxy::Data data;
  data.frame = read_frame(root);
  const auto tier = tier_from_name(text(root, "tier", ""));
  if (!tier) fail("tier", "paper, solid, tight or relief");
  data.tier = *tier;
  data.stature_m = number(root, "stature", "") * data.frame.meters_per_unit;
  data.margin_m = number(root, "margin", "") * data.frame.meters_per_unit;
  data.source_hash = hash_value(root, "source_hash");
  const SortedJson& ellipsoids = list(member(root, "ellipsoids", ""), "ellipsoids");
  for (std::size_t i = 0; i < ellipsoids.size(); ++i)
    data.ellipsoids.push_back(
        read_ellipsoid(ellipsoids[i], data.frame, "ellipsoids[" + std::to_string(i) + "]."));
  const SortedJson& relief = list(member(root, "relief", ""), "relief");
  for (std::size_t i = 0; i < relief.size(); ++i)
    data.relief.push_back(read_table(relief[i], data.frame, "relief[" + std::to_string(i) + "]."));
  data.texels = read_texels(text(root, "texels", ""));
  if (root.contains("binding")) data.binding = read_binding(root["binding"]);
  return data;
}

}  // namespace

engine::Result<BodyProxy> from_json(std::string_view source) {
  try {
    const SortedJson root = parse(source);
    check_format(root);
    auto proxy = BodyProxy::make(read_data(root));
    if (proxy && root.contains("hash") && hash_value(root, "hash") != proxy->hash())
      return engine::Error{
          engine::ErrorCode::kUnreadable,
          "Proxy JSON: the hash does not match the numbers: the file was changed or damaged.",
          "If it was edited on purpose, remove its 'hash'."};
    return proxy;
  } catch (const BadProxy& bad) {
    return bad.error;
  }
}

}  // namespace bodice::proxy
