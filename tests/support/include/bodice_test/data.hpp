#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

namespace bodice_test {

/// A file of the optional data folder, or nothing (said once on the test's output) when it is not there.
std::optional<std::filesystem::path> data_file(std::string_view relative);

}  // namespace bodice_test
