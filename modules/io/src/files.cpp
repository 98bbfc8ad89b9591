#include <bodice/io/files.hpp>

#include <cstdio>
#include <fstream>
#include <string>

#include <unistd.h>

namespace bodice::io {

namespace {

engine::Error write_error(const std::filesystem::path& file, const std::string& why, std::string remedy) {
  return {engine::ErrorCode::kWriteFailed, "'" + file.string() + "' could not be written: " + why + ".",
          std::move(remedy)};
}

/// A name beside the target that no other process uses.
std::filesystem::path temporary_beside(const std::filesystem::path& file) {
  std::filesystem::path temporary = file;
  temporary += ".part" + std::to_string(::getpid());
  return temporary;
}

/// Flushes to the disk's controller, so that a rename cannot come before the data.
bool write_whole(const std::filesystem::path& file, std::span<const std::byte> bytes) {
  std::FILE* stream = std::fopen(file.c_str(), "wb");
  if (!stream) return false;
  const bool written = std::fwrite(bytes.data(), 1, bytes.size(), stream) == bytes.size() &&
                       std::fflush(stream) == 0 && ::fsync(::fileno(stream)) == 0;
  return std::fclose(stream) == 0 && written;
}

}  // namespace

engine::Result<void> write_file(const std::filesystem::path& file, std::span<const std::byte> bytes) {
  std::error_code error;
  if (!file.has_filename()) return write_error(file, "the name is empty", "Name a file.");
  if (std::filesystem::is_directory(file, error))
    return write_error(file, "a directory of that name exists", "Choose another name.");
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  if (!std::filesystem::is_directory(folder, error))
    return write_error(file, "there is no folder '" + folder.string() + "'", "Create the folder first.");

  const std::filesystem::path temporary = temporary_beside(file);
  if (!write_whole(temporary, bytes)) {
    std::filesystem::remove(temporary, error);
    return write_error(file, "the folder refused it", "Check free space and write permission.");
  }
  std::filesystem::rename(temporary, file, error);
  if (error) {
    const std::string why = error.message();
    std::filesystem::remove(temporary, error);
    return write_error(file, why, "Check that the existing file may be replaced.");
  }
  return {};
}

engine::Result<void> write_file(const std::filesystem::path& file, std::string_view text) {
  return write_file(file, std::as_bytes(std::span(text.data(), text.size())));
}

}  // namespace bodice::io
