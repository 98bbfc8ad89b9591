#include <doctest/doctest.h>

#include <atomic>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <bodice/engine/write_file.hpp>
#include <bodice_test/temp_folder.hpp>

using namespace bodice::engine;
using bodice_test::TempFolder;

namespace fs = std::filesystem;

namespace {

std::string content(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::ptrdiff_t entries(const fs::path& folder) {
  return std::distance(fs::directory_iterator(folder), {});
}

}  // namespace

TEST_CASE("write_file replaces a file as a whole and leaves nothing beside it") {
  const TempFolder folder;
  const auto file = folder / "out.txt";
  REQUIRE(write_file(file, "first").ok());
  REQUIRE(write_file(file, std::string("sec\0nd", 6)).ok());
  CHECK(content(file) == std::string("sec\0nd", 6));
  CHECK(entries(folder.path()) == 1);
}

TEST_CASE("a file that is replaced keeps its permissions") {
  const TempFolder folder;
  const auto file = folder / "private.txt";
  REQUIRE(write_file(file, "first").ok());
  const auto only_mine = fs::perms::owner_read | fs::perms::owner_write;
  fs::permissions(file, only_mine);
  REQUIRE(write_file(file, "second").ok());
  CHECK(content(file) == "second");
  CHECK(fs::status(file).permissions() == only_mine);
}

TEST_CASE("write_file into a missing folder, over a directory or without a name fails in one sentence") {
  const TempFolder folder;
  for (const auto& file : {folder / "no/such/out.txt", folder.path(), fs::path()}) {
    const auto result = write_file(file, "text");
    REQUIRE(!result.ok());
    CHECK(result.error().code == ErrorCode::kWriteFailed);
    CHECK(result.error().message.ends_with('.'));
    CHECK(!result.error().remedy.empty());
  }
}

TEST_CASE("a write that fails halfway leaves the old file as it was, and nothing beside it") {
  const TempFolder folder;
  const auto file = folder / "out.txt";
  REQUIRE(write_file(file, "the old text").ok());
  rlimit before{};
  REQUIRE(::getrlimit(RLIMIT_FSIZE, &before) == 0);
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit small = before;
  small.rlim_cur = 1 << 16;
  REQUIRE(::setrlimit(RLIMIT_FSIZE, &small) == 0);
  const auto result = write_file(file, std::string(1 << 20, 'x'));
  REQUIRE(::setrlimit(RLIMIT_FSIZE, &before) == 0);
  std::signal(SIGXFSZ, old_handler);
  REQUIRE_FALSE(result.ok());
  CHECK(result.error().code == ErrorCode::kWriteFailed);
  CHECK(content(file) == "the old text");
  CHECK(entries(folder.path()) == 1);
}

TEST_CASE("a folder is not replaced by a file") {
  const TempFolder folder;
  fs::create_directories(folder / "out/inside");
  CHECK(!write_file(folder / "out", "text").ok());
  CHECK(fs::is_directory(folder / "out/inside"));
  CHECK(entries(folder.path()) == 1);
}

TEST_CASE("many writers of one file: each succeeds, readers see whole files only, nothing is left") {
  const TempFolder folder;
  const auto file = folder / "out.txt";
  constexpr std::size_t kBytes = 20'000;
  REQUIRE(write_file(file, std::string(kBytes, 'z')).ok());
  std::atomic<int> failed{0}, left{4};
  std::vector<std::thread> writers;
  for (int t = 0; t < 4; ++t) {
    writers.emplace_back([&, t] {
      for (int i = 0; i < 50; ++i)
        failed += !write_file(file, std::string(kBytes, static_cast<char>('a' + t))).ok();
      --left;
    });
  }
  int torn = 0;
  while (left > 0) {
    const std::string now = content(file);
    torn += now.size() != kBytes || now.find_first_not_of(now[0]) != std::string::npos;
  }
  for (std::thread& writer : writers) writer.join();
  CHECK(failed == 0);
  CHECK(torn == 0);
  CHECK(entries(folder.path()) == 1);
}

TEST_CASE("a symbolic link stays a link, and the file behind it is replaced") {
  const TempFolder folder;
  fs::create_directory(folder / "behind");
  const auto file = folder.write("behind/out.txt", "old");
  fs::create_symlink("behind/out.txt", folder / "link.txt");
  REQUIRE(write_file(folder / "link.txt", "new").ok());
  CHECK(fs::is_symlink(folder / "link.txt"));
  CHECK(content(file) == "new");
}

TEST_CASE("a symbolic link that points nowhere is refused, and stays") {
  const TempFolder folder;
  fs::create_symlink("nowhere/out.txt", folder / "link.txt");
  CHECK_FALSE(write_file(folder / "link.txt", "text").ok());
  CHECK(fs::is_symlink(folder / "link.txt"));
  CHECK(entries(folder.path()) == 1);
}

TEST_CASE("a pipe is written to, not replaced by a file") {
  const TempFolder folder;
  const auto pipe = folder / "pipe";
  REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
  const int both_ends = ::open(pipe.c_str(), O_RDWR | O_NONBLOCK);
  REQUIRE(both_ends >= 0);
  CHECK(write_file(pipe, "through the pipe").ok());
  CHECK(fs::is_fifo(pipe));
  char received[64];
  const auto bytes = ::read(both_ends, received, sizeof received);
  ::close(both_ends);
  REQUIRE(bytes > 0);
  CHECK(std::string(received, static_cast<std::size_t>(bytes)) == "through the pipe");
}

TEST_CASE("files that are flushed later are whole, and a folder is flushed or named") {
  const TempFolder folder;
  fs::create_directory(folder / "inner");
  {
    const UnflushedWrites until_later;
    REQUIRE(write_file(folder / "a.txt", "first").ok());
    REQUIRE(write_file(folder / "a.txt", "second").ok());
    CHECK_FALSE(write_file(folder / "missing/a.txt", "text").ok());
    CHECK_FALSE(write_file(folder / "inner", "text").ok());
  }
  CHECK(content(folder / "a.txt") == "second");
  CHECK(entries(folder / ".") == 2);
  CHECK(flush_files(folder / ".").ok());
  const auto missing = flush_files(folder / "missing");
  REQUIRE_FALSE(missing.ok());
  CHECK(missing.error().code == ErrorCode::kWriteFailed);
  CHECK(missing.error().message.find("missing") != std::string::npos);
}
