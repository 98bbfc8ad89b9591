#include "bench_support/origin.hpp"

#include <array>
#include <cstdio>
#include <fstream>
#include <memory>
#include <thread>

namespace bench {
namespace {

// The first line that a command prints; empty if it cannot be run.
std::string first_line_of(const char* command) {
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command, "r"), &pclose);
  std::array<char, 256> text{};
  if (!pipe || !std::fgets(text.data(), text.size(), pipe.get())) return {};
  std::string line(text.data());
  while (!line.empty() && line.back() == '\n') line.pop_back();
  return line;
}

std::string cpu_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  }
  return "unknown";
}

}  // namespace

Origin find_origin() {
  Origin origin;
  origin.commit = first_line_of("git -C '" BODICE_SOURCE_DIR "' describe --always --dirty 2>/dev/null");
  if (origin.commit.empty()) origin.commit = "unknown";
#if defined(__clang__)
  origin.compiler = "clang " __clang_version__;
#else
  origin.compiler = "g++ " __VERSION__;
#endif
  origin.flags = BENCH_FLAGS;
  origin.cpu = cpu_name();
  origin.hardware_threads = std::thread::hardware_concurrency();
  return origin;
}

std::string title(const Origin& origin) {
  return "commit " + origin.commit + ", " + origin.compiler + ", " + origin.cpu + ", " +
         std::to_string(origin.hardware_threads) + " hardware threads";
}

}  // namespace bench
