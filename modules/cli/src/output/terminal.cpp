#include "output/terminal.hpp"

#include <cstdio>

#include <unistd.h>

#include "options/options.hpp"

namespace bodice::inline v0_1::cli {

ProgressLine::ProgressLine(bool quiet) : enabled_(!quiet && isatty(STDERR_FILENO)) {}

ProgressLine::~ProgressLine() {
  clear();
}

tryon::Progress ProgressLine::callback() {
  if (!enabled_) return {};
  return [this](std::string_view stage, double fraction) { show(stage, fraction); };
}

void ProgressLine::show(std::string_view stage, double fraction) {
  constexpr int kWidth = 30;
  const int done = static_cast<int>(fraction * kWidth + 0.5);
  std::string line(stage);
  line.resize(14, ' ');
  line += fraction > 0.0 ? "[" + std::string(done, '#') + std::string(kWidth - done, '.') + "]" : "...";
  if (line == last_) return;
  std::fprintf(stderr, "\r\033[K%s", line.c_str());
  std::fflush(stderr);
  last_ = line;
  drawn_ = true;
}

void ProgressLine::clear() {
  if (drawn_) std::fprintf(stderr, "\r\033[K");
  drawn_ = false;
  last_.clear();
}

int fail(const engine::Error& error) {
  std::fprintf(stderr, "bodice: %s\n", error.sentence().c_str());
  return error.code == engine::ErrorCode::kInvalidArgument ? kExitUsage : kExitFailed;
}

}  // namespace bodice::cli
