// The files that a command reads and writes, checked before any work.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include <bodice/engine/result.hpp>

namespace bodice::inline v0_1::cli {

struct FileOption {
  std::string option;                        ///< its name on the command line
  std::string file;                          ///< empty if it was not given
  std::vector<std::string> extensions = {};  ///< extensions of its formats, lower case; empty: any
};

/// The extension in lower case, with its dot.
std::string extension_of(const std::filesystem::path& file);

/// Fails with kInvalidArgument when an output's extension is not one of its formats, or when the output is an
/// input or another output, by whatever path or link. Fails with kWriteFailed when it could not be written
/// after long work. Pipes and devices may have any name and take any number of outputs.
engine::Result<void> check_outputs(std::span<const FileOption> outputs, std::span<const FileOption> inputs);

}  // namespace bodice::cli
