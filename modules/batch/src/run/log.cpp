#include "run/log.hpp"

#include <cerrno>
#include <cstring>
#include <ctime>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

#include "process/outcome.hpp"
#include "results/result_store.hpp"

namespace bodice::inline v0_1::batch {
namespace {

namespace fs = std::filesystem;

engine::Error refused(const fs::path& file) {
  return {engine::ErrorCode::kWriteFailed,
          "'" + file.string() + "' could not be written: " + std::strerror(errno) + ".",
          "Free space on its disk, and start the batch again: it goes on where it ended."};
}

}  // namespace

Log::Log(fs::path file, int descriptor) : file_(std::move(file)), descriptor_(descriptor) {}

Log::Log(Log&& other) noexcept
    : file_(std::move(other.file_)), descriptor_(std::exchange(other.descriptor_, -1)) {}

Log::~Log() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

engine::Result<Log> Log::open(const fs::path& folder, const std::string& name) {
  const std::time_t now = std::time(nullptr);
  std::tm utc = {};
  char stamp[32] = {};
  ::gmtime_r(&now, &utc);
  std::strftime(stamp, sizeof stamp, "%Y%m%dT%H%M%SZ", &utc);
  const std::string begin = stamp + ("." + host_name()) + "." + std::to_string(::getpid()) + "." + name;
  for (int i = 0;; ++i) {
    const fs::path file = folder / (begin + (i ? "." + std::to_string(i) : "") + ".jsonl");
    const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_APPEND | O_CLOEXEC, 0666);
    if (descriptor >= 0) return Log(file, descriptor);
    if (errno != EEXIST) return refused(file);
  }
}

engine::Result<void> Log::add(const engine::SortedJson& line) {
  const std::string text = one_line(line) + "\n";
  ssize_t count;
  errno = ENOSPC;  // what a write of a part of the line means
  do count = ::write(descriptor_, text.data(), text.size());
  while (count < 0 && errno == EINTR);
  if (count == static_cast<ssize_t>(text.size())) return {};
  if (count >= 0) errno = ENOSPC;
  return refused(file_);
}

}  // namespace bodice::batch
