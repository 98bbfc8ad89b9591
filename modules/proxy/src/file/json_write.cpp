// The JSON form: lengths in the unit and directions in the axes of the body's file, one line an ellipsoid.
#include <string>

#include <bodice/engine/json.hpp>
#include <bodice/engine/text.hpp>
#include <bodice/proxy/proxy_file.hpp>

#include "binding/binding_bytes.hpp"
#include "file/json_form.hpp"

namespace bodice::inline v0_1::proxy {
namespace {

using engine::Json;
using geometry::Frame;
using geometry::Vec3;

Json array(const Vec3& v) {
  return {v[0] + 0.0, v[1] + 0.0, v[2] + 0.0};  // adding 0 turns -0 into 0
}

std::string ellipsoid_line(const ProxyEllipsoid& e, const Frame& frame) {
  Json object;
  object["part"] = body::name(e.part);
  if (e.bone != kNoBone) object["bone"] = e.bone;
  object["center"] = array(frame.to_file(e.shape.center));
  object["radii"] = array(e.shape.radii / frame.meters_per_unit);
  object["axes"] = Json::array();
  for (int k = 0; k < 3; ++k) object["axes"].push_back(array(frame.direction_to_file(e.shape.axes.col(k))));
  return object.dump();
}

std::string table_line(const ReliefTable& t, const Frame& frame) {
  auto length = [&](float meters) { return static_cast<double>(meters) / frame.meters_per_unit; };
  const Json object = {{"nodes", t.nodes_per_side},      {"first_texel", t.first_texel},
                       {"h_scale", length(t.h_scale_m)}, {"h_offset", length(t.h_offset_m)},
                       {"a_scale", length(t.a_scale)},   {"a_offset", length(t.a_offset)}};
  return object.dump();
}

/// Writes [ line, line, ... ] with each item on a line of its own.
template <class Items, class Line>
std::string lines(const Items& items, Line&& line) {
  std::string text = "[";
  const char* separator = "\n  ";
  for (const auto& item : items) {
    text += separator + line(item);
    separator = ",\n  ";
  }
  return text + "\n ]";
}

std::string texel_hex(std::span<const ReliefTexel> texels) {
  std::vector<std::byte> bytes;
  bytes.reserve(2 * texels.size());
  for (const ReliefTexel& texel : texels)
    bytes.insert(bytes.end(), {static_cast<std::byte>(texel.h), static_cast<std::byte>(texel.a)});
  return to_hex(bytes);
}

/// The joints' names for people, and the binding in its binary form: meters and y up in any file.
std::string binding_line(const Binding& binding) {
  ByteWriter bytes;
  put_binding(bytes, binding);
  Json object;
  object["joints"] = binding.joint_names;
  object["bytes"] = to_hex(bytes.written());
  return object.dump({.replaces_invalid = true});
}

}  // namespace

std::string to_json(const BodyProxy& proxy) {
  const Frame& frame = proxy.frame();
  std::string text = "{\n";
  auto field = [&](const char* key, const std::string& value, const char* end = ",\n") {
    text += " \"" + std::string(key) + "\": " + value + end;
  };
  field("format", Json(kJsonFormat).dump());
  field("version", Json(proxy.binding() ? kBoundJsonVersion : kJsonVersion).dump());
  field("tier", Json(name(proxy.tier())).dump());
  field("metres_per_unit", Json(frame.meters_per_unit).dump());
  field("up", Json(kAxisNames[static_cast<std::size_t>(frame.up)]).dump());
  field("stature", Json(proxy.stature_m() / frame.meters_per_unit).dump());
  field("margin", Json(proxy.margin_m() / frame.meters_per_unit).dump());
  field("source_hash", Json(engine::hex64(proxy.source_hash())).dump());
  field("hash", Json(engine::hex64(proxy.hash())).dump());
  field("ellipsoids", lines(proxy.ellipsoids(), [&](const auto& e) { return ellipsoid_line(e, frame); }));
  field("relief", lines(proxy.relief(), [&](const auto& t) { return table_line(t, frame); }));
  field("texels", Json(texel_hex(proxy.texels())).dump(), proxy.binding() ? ",\n" : "\n}\n");
  if (proxy.binding()) field("binding", binding_line(*proxy.binding()), "\n}\n");
  return text;
}

}  // namespace bodice::proxy
