// A disk that takes its time: the next job computes meanwhile.
#include <chrono>
#include <filesystem>
#include <fstream>
#include <thread>

#include <doctest/doctest.h>

#include <sys/syscall.h>
#include <unistd.h>

#include "fake_work.hpp"

using namespace bodice;
using bodice_test::BatchFolder;

namespace {

/// What the disk of this program waits for, in every process that is forked from it.
struct SlowDisk {
  std::filesystem::path counter;  ///< empty: for nothing
  std::uintmax_t until_bytes = 0;
  std::filesystem::path in_vain;  ///< is made where the counter did not grow in time
} slow_disk;

bool has_grown() {
  std::error_code none;
  const std::uintmax_t bytes = std::filesystem::file_size(slow_disk.counter, none);
  return !none && bytes >= slow_disk.until_bytes;
}

void wait_for_counter() {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  while (!has_grown()) {
    if (std::chrono::steady_clock::now() > end) {
      std::ofstream(slow_disk.in_vain) << "waited";
      return;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
}

}  // namespace

// Replaces the function of the system in this program.
extern "C" int fsync(int file) {
  if (!slow_disk.counter.empty()) wait_for_counter();
  return static_cast<int>(::syscall(SYS_fsync, file));
}

TEST_CASE("the next job computes while the disk takes the result of the last one") {
  BatchFolder folder({R"({"n": 1})", R"({"n": 2})"});
  folder.work.ran = folder / "ran";
  // With one job at a time, the second starts although the first is not on the disk.
  slow_disk = {.counter = folder / "ran", .until_bytes = 2, .in_vain = folder / "in_vain"};
  const auto result = folder.run({.jobs = 1});
  slow_disk = {};
  REQUIRE(result.ok());
  CHECK(result->end.done == 2);
  CHECK(folder.results().size() == 2);
  CHECK_FALSE(std::filesystem::exists(folder / "in_vain"));
}
