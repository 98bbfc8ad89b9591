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

/// Writes the outputs of a command one after the other, until one fails, and lists them.
class OutputWriter {
 public:
  explicit OutputWriter(std::vector<std::string>& written) : written_(written) {}

  /// `write` takes the name of the file and returns a Result<void>. An empty name, of an option that was not
  /// given, is left out.
  template <class Write>
  void write(const std::string& file, Write&& write) {
    if (file.empty() || !result_) return;
    result_ = write(file);
    if (result_) written_.push_back(file);
  }

  /// The failure of the first output that could not be written.
  const engine::Result<void>& result() const { return result_; }

 private:
  std::vector<std::string>& written_;
  engine::Result<void> result_;
};

}  // namespace bodice::cli
