// How far a batch is, while it runs.
#pragma once

#include <string>

#include <bodice/batch/batch.hpp>

namespace bodice::inline v0_1::cli {

/// "42 s", "17 min", "3.2 h", "5.1 days".
std::string duration_text(double seconds);

/// One line that is overwritten on a terminal; elsewhere a line twice a minute. Silent with --quiet.
class BatchProgressLine {
 public:
  explicit BatchProgressLine(bool quiet);
  void show(const batch::BatchProgress& now);
  void clear();

 private:
  bool quiet_, on_terminal_;
  double last_s_ = 0.0;
  std::string last_;
};

}  // namespace bodice::cli
