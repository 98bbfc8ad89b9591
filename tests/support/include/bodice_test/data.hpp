#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

namespace bodice_test {

/// A file of the optional data folder, or nothing if it is missing, which is reported once on the test's
/// output.
std::optional<std::filesystem::path> data_file(std::string_view relative);

}  // namespace bodice_test
