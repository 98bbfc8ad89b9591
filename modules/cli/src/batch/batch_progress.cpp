#include "batch/batch_progress.hpp"

#include <algorithm>
#include <cstdio>
#include <ctime>

#include <unistd.h>

#include <bodice/engine/message.hpp>

namespace bodice::inline v0_1::cli {
namespace {

constexpr double kBetweenLines_s = 30.0;

/// The clock time in so many seconds, with the day where it is not today.
std::string clock_text(double in_s) {
  const std::time_t now = std::time(nullptr), then = now + static_cast<std::time_t>(in_s);
  std::tm today = {}, local = {};
  ::localtime_r(&now, &today);
  ::localtime_r(&then, &local);
  char text[32] = {};
  const bool is_today = today.tm_yday == local.tm_yday && today.tm_year == local.tm_year;
  std::strftime(text, sizeof text, is_today ? "%H:%M" : "%Y-%m-%d %H:%M", &local);
  return text;
}

std::string line_of(const batch::BatchProgress& now) {
  std::string line = std::to_string(now.finished()) + " of " + std::to_string(now.total) + " jobs";
  if (now.there > 0) line += ", " + std::to_string(now.there) + " there before";
  if (now.failed > 0) line += ", " + std::to_string(now.failed) + " failed";
  if (now.left_s < 0.0) return line;
  const double an_hour = 3600.0 * static_cast<double>(now.done + now.failed) / std::max(now.seconds, 1e-3);
  return line + engine::message(", ", static_cast<long long>(an_hour), " an hour, ends ",
                                clock_text(now.left_s), " (in ", duration_text(now.left_s), ")");
}

}  // namespace

std::string duration_text(double seconds) {
  const auto rounded = [](double value) { return static_cast<long long>(value + 0.5); };
  if (seconds < 10.0) return engine::message(static_cast<double>(rounded(10.0 * seconds)) / 10.0, " s");
  if (seconds < 120.0) return engine::message(rounded(seconds), " s");
  if (seconds < 7200.0) return engine::message(rounded(seconds / 60.0), " min");
  if (seconds < 172800.0) return engine::message(static_cast<double>(rounded(seconds / 360.0)) / 10.0, " h");
  return engine::message(static_cast<double>(rounded(seconds / 8640.0)) / 10.0, " days");
}

BatchProgressLine::BatchProgressLine(bool quiet) : quiet_(quiet), on_terminal_(isatty(STDERR_FILENO) != 0) {}

void BatchProgressLine::show(const batch::BatchProgress& now) {
  if (quiet_) return;
  if (!on_terminal_) {
    if (now.seconds < last_s_ + kBetweenLines_s) return;
    last_s_ = now.seconds;
    std::fprintf(stderr, "%s\n", line_of(now).c_str());
    return;
  }
  const std::string line = line_of(now);
  if (line == last_) return;
  std::fprintf(stderr, "\r\033[K%s", line.c_str());
  std::fflush(stderr);
  last_ = line;
}

void BatchProgressLine::clear() {
  if (!last_.empty()) std::fprintf(stderr, "\r\033[K");
  last_.clear();
}

}  // namespace bodice::cli
