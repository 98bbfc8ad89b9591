// Files of proxies: JSON for people and tools (in the unit and axes of the body's file, BodyProxy::frame()),
// and a compact binary form for runtimes (meters, y up). Both have a version, and both give the same hash
// back. Loading hostile bytes is safe: every length and value is checked before it is used.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <bodice/proxy/body_proxy.hpp>

namespace bodice::inline v0_1::proxy {

/// The JSON form of a proxy. O(size of the proxy).
std::string to_json(const BodyProxy& proxy);
/// Reads the JSON form. Fails with kUnreadable where the text is no proxy, and with kInvalidArgument where a
/// number is out of range; the sentence names the line or the ellipsoid. O(size of the text).
engine::Result<BodyProxy> from_json(std::string_view text);
/// The binary form of a proxy. O(size of the proxy).
std::vector<std::byte> to_binary(const BodyProxy& proxy);
/// Reads the binary form. Fails as from_json(); needs no alignment of the bytes. O(size of the bytes).
engine::Result<BodyProxy> from_binary(std::span<const std::byte> bytes);

/// Writes the binary form if the name ends in .bodice, else JSON. The file appears whole or not at all. Fails
/// with kWriteFailed.
engine::Result<void> save(const BodyProxy& proxy, const std::filesystem::path& file);
/// Reads either form, which it recognizes by content. Fails with kNotFound, kUnreadable or kInvalidArgument,
/// and names the line and column or the ellipsoid at fault.
engine::Result<BodyProxy> load(const std::filesystem::path& file);

}  // namespace bodice::proxy
