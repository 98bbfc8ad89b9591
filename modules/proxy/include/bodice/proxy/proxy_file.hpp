// Proxies on disk: JSON for people and tools (in the units and axes of the body's file, BodyProxy::frame()),
// a compact binary for runtimes (meters, y up). Both are versioned, both give the same hash back, and loading
// hostile bytes is safe: every length and value is checked before it is used.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <bodice/proxy/body_proxy.hpp>

namespace bodice::proxy {

std::string to_json(const BodyProxy& proxy);
engine::Result<BodyProxy> from_json(std::string_view text);
std::vector<std::byte> to_binary(const BodyProxy& proxy);
engine::Result<BodyProxy> from_binary(std::span<const std::byte> bytes);

/// Writes JSON, or the binary form if the name ends in .bodice; the file appears whole or not at all.
engine::Result<void> save(const BodyProxy& proxy, const std::filesystem::path& file);
/// Reads either form, told apart by content.
engine::Result<BodyProxy> load(const std::filesystem::path& file);

}  // namespace bodice::proxy
