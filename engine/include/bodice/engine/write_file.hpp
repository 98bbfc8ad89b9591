// Output files that appear whole or not at all.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>

#include <bodice/engine/result.hpp>

namespace bodice::engine {

/// Writes to a new file beside the target, flushes it to the disk and renames it over the target. At any time
/// there is the old file or the whole new one, and any number of threads and processes may write it. A file
/// that is replaced keeps its permissions. A symbolic link keeps its target, unless the target is missing:
/// then it is refused. A pipe or device is written to directly. Fails with kWriteFailed and leaves nothing
/// behind.
Result<void> write_file(const std::filesystem::path& file, std::span<const std::byte> bytes);
Result<void> write_file(const std::filesystem::path& file, std::string_view text);

}  // namespace bodice::engine
