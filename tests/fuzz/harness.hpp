// The common parts of the harnesses: how one starts, a bounded reader of bytes, a temporary file, and a check
// that is always compiled.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <span>
#include <string>

#include <unistd.h>

#define FUZZ_CHECK(condition)                                                            \
  do {                                                                                   \
    if (!(condition)) {                                                                  \
      std::fprintf(stderr, "%s:%d: %s does not hold\n", __FILE__, __LINE__, #condition); \
      std::abort();                                                                      \
    }                                                                                    \
  } while (false)

namespace fuzz {

/// Reads numbers from the input; they are zero once it is used up.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : left_(data, size) {}
  std::uint8_t next() {
    if (left_.empty()) return 0;
    const std::uint8_t value = left_.front();
    left_ = left_.subspan(1);
    return value;
  }
  std::span<const std::uint8_t> rest() const { return left_; }

 private:
  std::span<const std::uint8_t> left_;
};

/// A file that holds the bytes, until the end of the scope.
class TemporaryFile {
 public:
  TemporaryFile(const char* extension, std::span<const std::uint8_t> bytes)
      : path_(std::filesystem::temp_directory_path() /
              ("bodice_fuzz_" + std::to_string(getpid()) + extension)) {
    std::ofstream(path_, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  }
  ~TemporaryFile() { std::filesystem::remove(path_); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Checks that the error has a sentence.
template <class Result>
void check_reported(const Result& result) {
  FUZZ_CHECK(result.ok() || result.error().message.size() > 8);
}

/// Takes the bytes of one case; returns 0.
using Harness = int (*)(const std::uint8_t* data, std::size_t size);

/// The harnesses of this program by their names.
inline std::map<std::string, Harness>& harnesses() {
  static std::map<std::string, Harness> all;
  return all;
}

struct Registered {
  Registered(const char* name, Harness harness) { harnesses().emplace(name, harness); }
};

}  // namespace fuzz

// FUZZ_TARGET(name) { ... return 0; } is the harness of a file, over its `data` and `size`. A program that
// replays cases has several harnesses; libFuzzer has one, which it calls by a name of its own.
#ifdef BODICE_REPLAY
#define FUZZ_TARGET(name)                                             \
  static int run_##name(const std::uint8_t* data, std::size_t size);  \
  static const fuzz::Registered registered_##name(#name, run_##name); \
  static int run_##name(const std::uint8_t* data, std::size_t size)
#else
#define FUZZ_TARGET(name) extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
#endif
