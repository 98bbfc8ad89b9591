// Files out: each appears whole or not at all.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>

#include <bodice/engine/result.hpp>

namespace bodice::engine {

/// Writes to a new file beside the target, flushes it to the disk and renames it over the target: at any time
/// there is the old file or the whole new one. Any number of threads and processes may write the same file;
/// one of them is last. A file that is replaced keeps its permissions, a symbolic link keeps pointing where
/// it did (one that points nowhere is refused), and a pipe or device is written to as it is. Fails with
/// kWriteFailed and leaves nothing behind.
Result<void> write_file(const std::filesystem::path& file, std::span<const std::byte> bytes);
Result<void> write_file(const std::filesystem::path& file, std::string_view text);

}  // namespace bodice::engine
