#include "results/result_key.hpp"

#include <cerrno>
#include <cstring>
#include <vector>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "manifest/job_text.hpp"
#include "manifest/sha256.hpp"

namespace bodice::inline v0_1::batch {
namespace {

using engine::Error;
using engine::ErrorCode;

constexpr std::size_t kMostKnown = 50'000;  // some 10 MB
constexpr std::size_t kKeyDigits = 32;      // 128 bits: 10^9 results share none

/// Closes a file descriptor.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int number() const { return number_; }

 private:
  int number_;
};

Error refused(const std::filesystem::path& file, const std::string& why, ErrorCode code) {
  return {code, "'" + file.string() + "' " + why + ".",
          "Check the path; it counts from the manifest's folder."};
}

}  // namespace

engine::Result<FileHashes::Known> FileHashes::look_up(const std::filesystem::path& file, const Work* work) {
  // A pipe would be waited for, and a device read without end: neither may hold up a batch.
  const Descriptor open(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  struct stat status = {};
  if (open.number() < 0 || ::fstat(open.number(), &status) != 0)
    return refused(file, std::string("cannot be opened: ") + std::strerror(errno), ErrorCode::kNotFound);
  if (!S_ISREG(status.st_mode)) return refused(file, "is not a file", ErrorCode::kUnreadable);
  if (known_.size() >= kMostKnown) known_.clear();
  Known& known = known_[file.string()];
  const Known now{status.st_size, status.st_mtim.tv_sec, status.st_mtim.tv_nsec, "", {}};
  if (!known.hash.empty() && known.size == now.size && known.seconds == now.seconds &&
      known.nanoseconds == now.nanoseconds)
    return known;
  known = now;
  Sha256 hash;
  std::vector<std::byte> chunk(std::size_t{1} << 18);
  for (ssize_t count; (count = ::read(open.number(), chunk.data(), chunk.size())) != 0;) {
    if (count < 0) return refused(file, "cannot be read", ErrorCode::kUnreadable);
    hash.add(std::span<const std::byte>(chunk.data(), static_cast<std::size_t>(count)));
  }
  known.hash = hex(hash.finish());
  if (work) known.beside = work->files_beside(file);
  return known;
}

engine::Result<std::string> FileHashes::of(const std::filesystem::path& file, const Work& work) {
  auto whole = look_up(file, &work);
  if (!whole) return std::move(whole).error();
  std::string hashes = whole->hash;
  for (const std::filesystem::path& part : whole->beside) {
    auto known = look_up(part, nullptr);
    if (!known) return std::move(known).error();
    hashes += ' ' + known->hash;
  }
  return hashes;
}

engine::Result<std::string> result_key(const Job& job, const Work& work, FileHashes& files) {
  Job by_content = job;
  for (auto& [name, values] : by_content.values)
    for (std::string& value : values) {
      if (!work.is_file(name, value)) continue;
      auto hash = files.of(value, work);
      if (!hash) return std::move(hash).error();
      value = "sha256 " + hash.value();
    }
  Sha256 hash;
  hash.add("bodice batch 1\n" + work.version() + "\n" + text_of(by_content));
  return hex(hash.finish()).substr(0, kKeyDigits);
}

}  // namespace bodice::batch
