// The section of base poses that may follow the bytes of a binary proxy (base_pose_file.cpp).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace bodice::inline v0_1::proxy {

/// The section without its length and magic; empty where there is none.
std::span<const std::byte> base_section(std::span<const std::byte> file);

/// The bytes of the proxy alone.
std::span<const std::byte> without_base_section(std::span<const std::byte> file);

/// Appends a section, its length and its magic.
void append_base_section(std::span<const std::byte> section, std::vector<std::byte>& file);

}  // namespace bodice::proxy
