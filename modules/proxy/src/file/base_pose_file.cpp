// Base poses in files. In the binary form they follow the proxy's own bytes:
//   u32 version, u64 hash of the proxy, u32 #bases, and of each
//     u16 length of the name, the name's bytes, f64 joint[12] by columns of each joint
//     table:      f32 h scale, h offset, a scale, a offset
//     texel:      u8 h, u8 a
//   u64 checksum of all this, u64 its length with the checksum, magic "BODICEBP"
// In JSON the same bytes without the last two stand as hexadecimal digits in the member "base_poses".
#include <fstream>
#include <utility>

#include <bodice/engine/hash.hpp>
#include <bodice/engine/json.hpp>
#include <bodice/engine/write_file.hpp>
#include <bodice/proxy/base_pose.hpp>
#include <bodice/proxy/proxy_file.hpp>

#include "bytes/bytes.hpp"
#include "file/base_section.hpp"
#include "file/json_form.hpp"
#include "file/proxy_binary.hpp"

namespace bodice::inline v0_1::proxy {
namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t kBasesVersion = 1;
constexpr const char* kJsonKey = "base_poses";

engine::Error damaged_bases(std::string what) {
  return {engine::ErrorCode::kUnreadable, "Base poses: " + std::move(what) + ".",
          "Write the file again with 'bodice fit'."};
}

void put_base(ByteWriter& out, const BasePose& base) {
  out.put(static_cast<std::uint16_t>(base.name.size()));
  for (const char c : base.name) out.put(static_cast<std::uint8_t>(c));
  for (const JointMatrix& joint : base.joints)
    for (int i = 0; i < 12; ++i) out.put(joint.data()[i]);
  for (const ReliefTable& t : base.relief)
    for (const float value : {t.h_scale_m, t.h_offset_m, t.a_scale, t.a_offset}) out.put(value);
  for (const ReliefTexel& texel : base.texels) {
    out.put(texel.h);
    out.put(texel.a);
  }
}

/// The bytes of the section of base poses with its checksum, without length and magic.
std::vector<std::byte> bases_bytes(const ProxyWithBases& both) {
  ByteWriter out;
  out.put(kBasesVersion);
  out.put(both.proxy.hash());
  out.put(static_cast<std::uint32_t>(both.bases.size()));
  for (const auto& base : both.bases) put_base(out, *base);
  out.put(checksum(out.written()));
  return out.take();
}

bool get_base(ByteReader& in, const BodyProxy& bound, BasePose& base) {
  const std::size_t length = in.get<std::uint16_t>();
  const std::size_t joints = bound.binding()->joint_names.size();
  if (!in.ok() || length + joints * 96 + bound.relief().size() * 16 + bound.texels().size() * 2 > in.left())
    return false;
  for (std::size_t i = 0; i < length; ++i) base.name += static_cast<char>(in.get<std::uint8_t>());
  base.joints.resize(joints);
  for (JointMatrix& joint : base.joints)
    for (int i = 0; i < 12; ++i) joint.data()[i] = in.get_double();
  base.relief.assign(bound.relief().begin(), bound.relief().end());
  for (ReliefTable& t : base.relief)
    for (float* value : {&t.h_scale_m, &t.h_offset_m, &t.a_scale, &t.a_offset}) *value = in.get_float();
  base.texels.resize(bound.texels().size());
  for (ReliefTexel& texel : base.texels) {
    texel.h = in.get<std::uint8_t>();
    texel.a = in.get<std::uint8_t>();
  }
  return in.ok();
}

engine::Result<BasePoses> get_bases(const BodyProxy& bound, std::span<const std::byte> bytes) {
  constexpr std::size_t kChecksumBytes = 8;
  if (bytes.empty()) return BasePoses{};
  if (bytes.size() < kChecksumBytes) return damaged_bases("they are cut short");
  const auto content = bytes.first(bytes.size() - kChecksumBytes);
  if (ByteReader(bytes.last(kChecksumBytes)).get<std::uint64_t>() != checksum(content))
    return damaged_bases("their checksum does not match");
  ByteReader in(content);
  if (const auto version = in.get<std::uint32_t>(); version != kBasesVersion)
    return damaged_bases("version " + std::to_string(version) + " is not known here");
  if (in.get<std::uint64_t>() != bound.hash() || !bound.binding())
    return damaged_bases("they are of another proxy");
  const auto count = in.get<std::uint32_t>();
  BasePoses bases;
  for (std::uint32_t i = 0; i < count; ++i) {
    BasePose base;
    if (!get_base(in, bound, base)) return damaged_bases("their counts do not fit their length");
    if (auto fit = check_base(bound, base); !fit) return std::move(fit).error();
    bases.push_back(std::make_shared<const BasePose>(std::move(base)));
  }
  if (in.left() != 0) return damaged_bases("their counts do not fit their length");
  return bases;
}

std::string json_with_bases(const ProxyWithBases& both) {
  constexpr std::string_view kEnd = "\n}\n";
  std::string text = to_json(both.proxy);
  engine::Json names = engine::Json::array();
  for (const auto& base : both.bases) names.push_back(base->name);
  const engine::Json member = {{"names", names}, {"bytes", to_hex(bases_bytes(both))}};
  text.erase(text.size() - kEnd.size());
  return text + ",\n \"" + kJsonKey + "\": " + member.dump({.replaces_invalid = true}) + std::string(kEnd);
}

/// The base poses' bytes of a file that load() has read without fault.
std::vector<std::byte> bases_in(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  const std::string text((std::istreambuf_iterator<char>(in)), {});
  const auto bytes = std::as_bytes(std::span(text));
  if (is_binary_proxy(bytes)) {
    const auto section = base_section(bytes);
    return {section.begin(), section.end()};
  }
  const auto root = engine::SortedJson::parse_or_null(text);
  if (!root.is_object() || !root.contains(kJsonKey)) return {};
  const auto& member = root[kJsonKey];
  if (!member.is_object() || !member.contains("bytes") || !member["bytes"].is_string()) return {};
  return from_hex(member["bytes"].get<std::string>()).value_or(std::vector<std::byte>{});
}

}  // namespace

engine::Result<void> save_with_bases(const ProxyWithBases& both, const fs::path& file) {
  if (both.bases.empty()) return save(both.proxy, file);
  for (const auto& base : both.bases)
    if (auto fit = check_base(both.proxy, *base); !fit) return fit;
  if (!is_named_binary(file)) return engine::write_file(file, json_with_bases(both));
  std::vector<std::byte> bytes = to_binary(both.proxy);
  append_base_section(bases_bytes(both), bytes);
  return engine::write_file(file, bytes);
}

engine::Result<ProxyWithBases> load_with_bases(const fs::path& file) {
  auto proxy = load(file);
  if (!proxy) return std::move(proxy).error();
  auto bases = get_bases(*proxy, bases_in(file));
  if (bases) return ProxyWithBases{std::move(proxy).value(), std::move(bases).value()};
  engine::Error error = std::move(bases).error();
  error.message = file.string() + ": " + error.message;
  return error;
}

}  // namespace bodice::proxy
