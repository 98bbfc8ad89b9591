// The binary form, little-endian:
//   magic "BODICEPX", u32 version
//   u8 tier, u8 up axis, u16 0, f64 meters per unit, f64 stature, f64 margin, u64 source hash
//   u32 #ellipsoids, u32 #tables, u32 #texels
//   ellipsoid:  f64 center[3], f64 axes[9] by columns, f64 radii[3], u8 part, u8 0, u16 bone     124 bytes
//   table:      u16 nodes a side, u16 0, f32 h scale, h offset, a scale, a offset, u32 first      24 bytes
//   texel:      u8 h, u8 a
//   since version 3: u32 1 and a binding (binding/binding_bytes.hpp)
//   u64 checksum of all bytes before it; base poses may follow (base_pose_file.cpp)
#include "file/proxy_binary.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <string>

#include <bodice/engine/hash.hpp>
#include <bodice/proxy/proxy_file.hpp>

#include "binding/binding_bytes.hpp"
#include "bytes/bytes.hpp"
#include "file/base_section.hpp"

namespace bodice::inline v0_1::proxy {
namespace {

constexpr std::array<char, 8> kMagic = {'B', 'O', 'D', 'I', 'C', 'E', 'P', 'X'};
// Proxies without a binding are written in version 2, so that earlier builds read them.
constexpr std::uint32_t kVersion = 2, kBoundVersion = 3;
constexpr std::uint64_t kEllipsoidBytes = 124, kTableBytes = 24, kTexelBytes = 2, kChecksumBytes = 8;

engine::Error damaged(std::string what) {
  return {engine::ErrorCode::kUnreadable, "Binary proxy: " + std::move(what) + ".",
          "Write the file again with 'bodice fit'."};
}

void put_ellipsoid(ByteWriter& out, const ProxyEllipsoid& e) {
  for (int k = 0; k < 3; ++k) out.put(e.shape.center[k]);
  for (int k = 0; k < 9; ++k) out.put(e.shape.axes.data()[k]);
  for (int k = 0; k < 3; ++k) out.put(e.shape.radii[k]);
  out.put(static_cast<std::uint8_t>(e.part));
  out.put(std::uint8_t{0});
  out.put(static_cast<std::uint16_t>(e.bone));
}

ProxyEllipsoid get_ellipsoid(ByteReader& in) {
  ProxyEllipsoid e;
  for (int k = 0; k < 3; ++k) e.shape.center[k] = in.get_double();
  for (int k = 0; k < 9; ++k) e.shape.axes.data()[k] = in.get_double();
  for (int k = 0; k < 3; ++k) e.shape.radii[k] = in.get_double();
  e.part = static_cast<body::Part>(in.get<std::uint8_t>());
  in.get<std::uint8_t>();
  e.bone = static_cast<std::int16_t>(in.get<std::uint16_t>());
  return e;
}

void put_table(ByteWriter& out, const ReliefTable& t) {
  out.put(t.nodes_per_side);
  out.put(std::uint16_t{0});
  for (float value : {t.h_scale_m, t.h_offset_m, t.a_scale, t.a_offset}) out.put(value);
  out.put(t.first_texel);
}

ReliefTable get_table(ByteReader& in) {
  ReliefTable t;
  t.nodes_per_side = in.get<std::uint16_t>();
  in.get<std::uint16_t>();
  for (float* value : {&t.h_scale_m, &t.h_offset_m, &t.a_scale, &t.a_offset}) *value = in.get_float();
  t.first_texel = in.get<std::uint32_t>();
  return t;
}

void put_header(ByteWriter& out, const BodyProxy& proxy) {
  for (char c : kMagic) out.put(static_cast<std::uint8_t>(c));
  out.put(proxy.binding() ? kBoundVersion : kVersion);
  out.put(static_cast<std::uint8_t>(proxy.tier()));
  out.put(static_cast<std::uint8_t>(proxy.frame().up));
  out.put(std::uint16_t{0});
  for (double value : {proxy.frame().meters_per_unit, proxy.stature_m(), proxy.margin_m()}) out.put(value);
  out.put(proxy.source_hash());
}

/// Reads what lies between the magic and the checksum. Sizes are compared before anything is allocated.
engine::Result<BodyProxy> read_body(ByteReader& in, std::uint32_t version) {
  BodyProxy::Data data;
  data.tier = static_cast<Tier>(in.get<std::uint8_t>());
  data.frame.up = static_cast<geometry::Axis>(in.get<std::uint8_t>());
  in.get<std::uint16_t>();
  data.frame.meters_per_unit = in.get_double();
  data.stature_m = in.get_double();
  data.margin_m = in.get_double();
  data.source_hash = in.get<std::uint64_t>();
  const std::uint64_t ellipsoids = in.get<std::uint32_t>();
  const std::uint64_t tables = in.get<std::uint32_t>();
  const std::uint64_t texels = in.get<std::uint32_t>();
  const std::uint64_t rest = ellipsoids * kEllipsoidBytes + tables * kTableBytes + texels * kTexelBytes;
  if (!in.ok() || (version == kVersion ? in.left() != rest : in.left() < rest))
    return damaged("its counts do not fit its length");
  for (std::uint64_t i = 0; i < ellipsoids; ++i) data.ellipsoids.push_back(get_ellipsoid(in));
  for (std::uint64_t i = 0; i < tables; ++i) data.relief.push_back(get_table(in));
  for (std::uint64_t i = 0; i < texels; ++i) {
    const auto h = in.get<std::uint8_t>();
    data.texels.push_back({h, in.get<std::uint8_t>()});
  }
  if (version == kBoundVersion) {
    auto binding = std::make_shared<Binding>();
    if (in.get<std::uint32_t>() != 1 || !get_binding(in, *binding))
      return damaged("the counts of its binding do not fit its length");
    data.binding = std::move(binding);
  }
  return BodyProxy::make(std::move(data));
}

}  // namespace

bool is_binary_proxy(std::span<const std::byte> bytes) {
  return bytes.size() >= kMagic.size() &&
         std::equal(kMagic.begin(), kMagic.end(), bytes.begin(),
                    [](char c, std::byte b) { return static_cast<std::byte>(c) == b; });
}

std::vector<std::byte> to_binary(const BodyProxy& proxy) {
  ByteWriter out;
  put_header(out, proxy);
  out.put(static_cast<std::uint32_t>(proxy.ellipsoids().size()));
  out.put(static_cast<std::uint32_t>(proxy.relief().size()));
  out.put(static_cast<std::uint32_t>(proxy.texels().size()));
  for (const ProxyEllipsoid& e : proxy.ellipsoids()) put_ellipsoid(out, e);
  for (const ReliefTable& t : proxy.relief()) put_table(out, t);
  for (const ReliefTexel& texel : proxy.texels()) {
    out.put(texel.h);
    out.put(texel.a);
  }
  if (proxy.binding()) {
    out.put(std::uint32_t{1});
    put_binding(out, *proxy.binding());
  }
  out.put(checksum(out.written()));
  return out.take();
}

engine::Result<BodyProxy> from_binary(std::span<const std::byte> file) {
  const std::span<const std::byte> bytes = without_base_section(file);
  if (!is_binary_proxy(bytes)) return damaged("it does not begin with BODICEPX");
  if (bytes.size() < kMagic.size() + sizeof(kVersion) + kChecksumBytes) return damaged("it is cut short");
  const std::span<const std::byte> content = bytes.first(bytes.size() - kChecksumBytes);
  ByteReader in(content.subspan(kMagic.size()));
  const auto version = in.get<std::uint32_t>();
  if (version != kVersion && version != kBoundVersion)
    return engine::Error{engine::ErrorCode::kUnreadable,
                         "Binary proxy: version " + std::to_string(version) + " is not known here.",
                         "This build reads versions " + std::to_string(kVersion) + " and " +
                             std::to_string(kBoundVersion) + "."};
  if (ByteReader(bytes.last(kChecksumBytes)).get<std::uint64_t>() != checksum(content))
    return damaged("its checksum does not match");
  return read_body(in, version);
}

}  // namespace bodice::proxy
