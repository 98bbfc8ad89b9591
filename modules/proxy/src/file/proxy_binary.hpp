#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

namespace bodice::inline v0_1::proxy {

/// Whether the bytes begin as a binary proxy does.
bool is_binary_proxy(std::span<const std::byte> bytes);

/// Whether a file of this name gets the binary form.
bool is_named_binary(const std::filesystem::path& file);

}  // namespace bodice::proxy
