// The files that a command reads and writes, judged before any work.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include <bodice/engine/result.hpp>

namespace bodice::cli {

struct FileOption {
  std::string option;                        ///< as the command line names it
  std::string file;                          ///< empty: not given
  std::vector<std::string> extensions = {};  ///< that an output can be written in, lower case; empty: any
};

/// In lower case, with its dot.
std::string extension_of(const std::filesystem::path& file);

/// Fails with kInvalidArgument when an output's extension is none of its own, or when it is one of the inputs
/// or another output, by whatever path or link; with kWriteFailed when it could not be written after long
/// work. Pipes and devices may have any name and take any number of outputs.
engine::Result<void> check_outputs(std::span<const FileOption> outputs, std::span<const FileOption> inputs);

}  // namespace bodice::cli
