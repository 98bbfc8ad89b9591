// Files out: each appears whole or not at all.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>

#include <bodice/engine/result.hpp>

namespace bodice::io {

/// Writes beside the target and renames; an existing file is replaced only by a whole one.
engine::Result<void> write_file(const std::filesystem::path& file, std::span<const std::byte> bytes);
engine::Result<void> write_file(const std::filesystem::path& file, std::string_view text);

}  // namespace bodice::io
