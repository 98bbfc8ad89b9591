// Messages of the program while it works: progress on a terminal, errors in one sentence.
#pragma once

#include <string>
#include <string_view>

#include <bodice/engine/result.hpp>
#include <bodice/tryon/prepare.hpp>

namespace bodice::inline v0_1::cli {

/// Draws one line that is overwritten as the work proceeds. It is silent when the standard error stream is no
/// terminal or --quiet was given.
class ProgressLine {
 public:
  explicit ProgressLine(bool quiet);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  tryon::Progress callback();
  void clear();

 private:
  void show(std::string_view stage, double fraction);
  bool enabled_;
  bool drawn_ = false;
  std::string last_;
};

/// Prints "bodice: <sentence>" and returns the exit code, which is that of bad usage for kInvalidArgument.
int fail(const engine::Error& error);

}  // namespace bodice::cli
