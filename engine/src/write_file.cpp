#include <bodice/engine/write_file.hpp>

#include <cerrno>
#include <cstdio>
#include <string>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

namespace bodice::inline v0_1::engine {
namespace {

namespace fs = std::filesystem;

/// The number of writers in this process that may write one file at a time; leftovers of killed ones count.
constexpr int kMostBeside = 1000;

/// How many UnflushedWrites live on this thread.
thread_local int unflushed = 0;

Error write_error(const fs::path& file, const std::string& why, std::string remedy) {
  return {ErrorCode::kWriteFailed, "'" + file.string() + "' could not be written: " + why + ".",
          std::move(remedy)};
}

Error refused(const fs::path& file, std::error_code why) {
  return write_error(file, why.message(), "Check the path, write permission and free space.");
}

std::error_code last_error() {
  return {errno != 0 ? errno : EIO, std::generic_category()};  // a failure without errno is still a failure
}

/// Closes the stream. With `to_disk`, the bytes have left the system's memory, so that a rename cannot
/// precede them.
std::error_code put(std::FILE* stream, std::span<const std::byte> bytes, bool to_disk) {
  errno = 0;
  const bool written = std::fwrite(bytes.data(), 1, bytes.size(), stream) == bytes.size() &&
                       std::fflush(stream) == 0 && (!to_disk || ::fsync(::fileno(stream)) == 0);
  const std::error_code failure = written ? std::error_code() : last_error();
  if (std::fclose(stream) != 0 && written) return last_error();
  return failure;
}

/// Creates a file that did not exist, and its name; no other writer has it.
std::FILE* open_beside(const fs::path& file, fs::path& beside) {
  for (int i = 0; i < kMostBeside; ++i) {
    beside = file;
    beside += "." + std::to_string(::getpid()) + "-" + std::to_string(i) + ".part";
    std::FILE* const stream = std::fopen(beside.c_str(), "wbx");
    if (stream || errno != EEXIST) return stream;
  }
  return nullptr;
}

Result<void> replace(const fs::path& file, std::span<const std::byte> bytes) {
  fs::path beside;
  std::FILE* const stream = open_beside(file, beside);
  if (!stream) return refused(file, last_error());
  std::error_code failure = put(stream, bytes, unflushed == 0), ignored;
  const fs::file_status old = fs::status(file, ignored);
  if (fs::exists(old)) fs::permissions(beside, old.permissions(), ignored);  // the readers stay the same
  if (!failure) fs::rename(beside, file, failure);
  if (!failure) return {};
  fs::remove(beside, ignored);
  return refused(file, failure);
}

Result<void> write_through(const fs::path& file, std::span<const std::byte> bytes) {
  std::FILE* const stream = std::fopen(file.c_str(), "wb");
  if (!stream) return refused(file, last_error());
  const std::error_code failure = put(stream, bytes, false);
  if (failure) return refused(file, failure);
  return {};
}

std::error_code flush(const fs::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return last_error();
  const std::error_code failure = ::fsync(descriptor) == 0 ? std::error_code() : last_error();
  ::close(descriptor);
  return failure;
}

}  // namespace

UnflushedWrites::UnflushedWrites() {
  ++unflushed;
}

UnflushedWrites::~UnflushedWrites() {
  --unflushed;
}

Result<void> flush_files(const fs::path& folder) {
  std::error_code failure;
  for (fs::directory_iterator entry(folder, failure), end; !failure && entry != end; entry.increment(failure))
    if (entry->is_regular_file(failure) && !failure)
      if (const std::error_code file = flush(entry->path())) return refused(entry->path(), file);
  if (!failure) failure = flush(folder);
  if (failure) return refused(folder, failure);
  return {};
}

Result<void> write_file(const fs::path& file, std::span<const std::byte> bytes) {
  if (!file.has_filename()) return write_error(file, "the name is empty", "Name a file.");
  std::error_code ignored;
  const fs::path folder = file.has_parent_path() ? file.parent_path() : ".";
  if (!fs::is_directory(folder, ignored))
    return write_error(file, "there is no folder '" + folder.string() + "'", "Create the folder first.");
  const fs::file_status status = fs::status(file, ignored);
  if (fs::is_directory(status))
    return write_error(file, "a directory of that name exists", "Choose another name.");
  if (fs::exists(status) && !fs::is_regular_file(status)) return write_through(file, bytes);
  if (!fs::is_symlink(file, ignored)) return replace(file, bytes);
  std::error_code failure;
  const fs::path target = fs::canonical(file, failure);
  if (failure) return refused(file, failure);
  return replace(target, bytes);
}

Result<void> write_file(const fs::path& file, std::string_view text) {
  return write_file(file, std::as_bytes(std::span(text.data(), text.size())));
}

}  // namespace bodice::engine
