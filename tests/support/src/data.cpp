#include <bodice_test/data.hpp>

#include <doctest/doctest.h>

namespace bodice_test {

std::optional<std::filesystem::path> data_file(std::string_view relative) {
  std::filesystem::path path = std::filesystem::path(BODICE_TEST_DATA) / relative;
  if (std::filesystem::exists(path)) return path;
  MESSAGE("skipped: no data file " << std::string(relative));
  return std::nullopt;
}

}  // namespace bodice_test
