#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include <bodice/io/files.hpp>

#include "temp_folder.hpp"

using namespace bodice;

namespace {

std::string content(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace

TEST_CASE("write_file replaces a file as a whole and leaves nothing beside it") {
  const io_test::TempFolder folder;
  const auto file = folder / "out.txt";
  REQUIRE(io::write_file(file, "first").ok());
  REQUIRE(io::write_file(file, std::string("sec\0nd", 6)).ok());
  CHECK(content(file) == std::string("sec\0nd", 6));
  CHECK(std::distance(std::filesystem::directory_iterator(folder.path()), {}) == 1);
}

TEST_CASE("write_file into a missing folder, over a directory or without a name fails in one sentence") {
  const io_test::TempFolder folder;
  for (const auto& file : {folder / "no/such/out.txt", folder.path(), std::filesystem::path()}) {
    const auto result = io::write_file(file, "text");
    REQUIRE(!result.ok());
    CHECK(result.error().code == engine::ErrorCode::kWriteFailed);
    CHECK(result.error().message.ends_with('.'));
    CHECK(!result.error().remedy.empty());
  }
}

TEST_CASE("a failed write leaves the old file untouched") {
  const io_test::TempFolder folder;
  std::filesystem::create_directories(folder / "out/inside");
  CHECK(!io::write_file(folder / "out", "text").ok());
  CHECK(std::filesystem::is_directory(folder / "out/inside"));
  CHECK(std::distance(std::filesystem::directory_iterator(folder.path()), {}) == 1);
}
