#include "output/outputs.hpp"

#include <algorithm>
#include <cctype>

#include <unistd.h>

namespace bodice::inline v0_1::cli {
namespace {

namespace fs = std::filesystem;
using engine::Error;
using engine::ErrorCode;

bool is_stream(const fs::path& file) {
  std::error_code ignored;
  const fs::file_status status = fs::status(file, ignored);
  return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

bool same_file(const fs::path& a, const fs::path& b) {
  std::error_code error;
  if (fs::equivalent(a, b, error)) return true;  // the same file, perhaps by links of either kind
  const auto resolved = [&error](const fs::path& file) {
    return fs::weakly_canonical(fs::absolute(file, error), error);
  };
  return resolved(a) == resolved(b);
}

engine::Result<void> check_extension(const FileOption& output) {
  const std::vector<std::string>& known = output.extensions;
  if (known.empty() || std::ranges::find(known, extension_of(output.file)) != known.end()) return {};
  std::string names;
  for (const std::string& name : known) names += (names.empty() ? "NAME" : " or NAME") + name;
  return Error{ErrorCode::kInvalidArgument, output.option + " writes " + names + ", not " + output.file + ".",
               "Change the extension, which gives the format."};
}

engine::Result<void> check_apart(const FileOption& output, std::span<const FileOption> others) {
  for (const FileOption& other : others)
    if (!other.file.empty() && same_file(output.file, other.file))
      return Error{
          ErrorCode::kInvalidArgument,
          output.option + " " + output.file + " would overwrite " + other.option + " " + other.file + ".",
          "Name another file."};
  return {};
}

engine::Result<void> check_writable(const std::string& file) {
  std::error_code ignored;
  fs::path folder = fs::path(file).parent_path();
  if (folder.empty()) folder = ".";
  if (fs::is_directory(file, ignored))
    return Error{ErrorCode::kWriteFailed, file + " is a folder.", "Name a file in it."};
  if (!fs::is_directory(folder, ignored))
    return Error{ErrorCode::kWriteFailed, "The folder of " + file + " does not exist.", "Make it first."};
  if (access(folder.c_str(), W_OK) != 0)
    return Error{ErrorCode::kWriteFailed, "The folder of " + file + " cannot be written to.",
                 "Choose another or change its permissions."};
  return {};
}

}  // namespace

std::string extension_of(const fs::path& file) {
  std::string extension = file.extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

engine::Result<void> check_outputs(std::span<const FileOption> outputs, std::span<const FileOption> inputs) {
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const FileOption& output = outputs[i];
    if (output.file.empty() || is_stream(output.file)) continue;
    if (auto ok = check_extension(output); !ok) return ok;
    if (auto ok = check_apart(output, inputs); !ok) return ok;
    if (auto ok = check_apart(output, outputs.first(i)); !ok) return ok;
    if (auto ok = check_writable(output.file); !ok) return ok;
  }
  return {};
}

}  // namespace bodice::cli
