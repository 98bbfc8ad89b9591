// Output files that appear whole or not at all.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>

#include <bodice/engine/result.hpp>

namespace bodice::inline v0_1::engine {

/// Writes to a new file beside the target, flushes it to the disk and renames it over the target. At any time
/// there is the old file or the whole new one, and any number of threads and processes may write it. A file
/// that is replaced keeps its permissions. A symbolic link keeps its target, unless the target is missing:
/// then it is refused. A pipe or device is written to directly. Fails with kWriteFailed and leaves nothing
/// behind.
Result<void> write_file(const std::filesystem::path& file, std::span<const std::byte> bytes);
/// The same for text.
Result<void> write_file(const std::filesystem::path& file, std::string_view text);

/// While one lives, write_file() on its thread does not wait for the disk. For files of a folder that
/// is not visible yet: flush_files() makes up for it, in another process if need be, before it appears.
class UnflushedWrites {
 public:
  UnflushedWrites();
  ~UnflushedWrites();
  UnflushedWrites(const UnflushedWrites&) = delete;
  UnflushedWrites& operator=(const UnflushedWrites&) = delete;
};

/// Waits until the folder and the files in it, not those in its folders, are on the disk. Fails with
/// kWriteFailed.
Result<void> flush_files(const std::filesystem::path& folder);

}  // namespace bodice::engine
