// Runs a harness on every kept case, and on mutations of them. The mutations are the same in every run.
//
//     replay_<group> NAME CASES MUTATIONS
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <vector>

#include <bodice/engine/random.hpp>

#include "harness.hpp"

namespace {

using Case = std::vector<std::uint8_t>;

std::vector<Case> cases_in(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) files.push_back(entry.path());
  std::ranges::sort(files);  // directories are listed in any order
  std::vector<Case> cases;
  for (const auto& file : files) {
    std::ifstream in(file, std::ios::binary);
    cases.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
  }
  return cases;
}

/// The bytes with a few changed, inserted or removed, or without their end.
Case mutated(Case bytes, bodice::engine::Random& random) {
  for (std::uint64_t edits = 1 + random.below(4); edits > 0; --edits) {
    const std::size_t at = bytes.empty() ? 0 : random.below(bytes.size());
    const auto value = static_cast<std::uint8_t>(random.below(256));
    const auto position = bytes.begin() + static_cast<std::ptrdiff_t>(at);
    switch (random.below(5)) {
      case 0:
        bytes.insert(position, value);
        break;
      case 1:
        if (!bytes.empty()) bytes.erase(position);
        break;
      case 2:
        if (random.below(8) == 0) bytes.resize(at);
        break;
      default:
        if (!bytes.empty()) *position = value;
    }
  }
  return bytes;
}

const Case* running = nullptr;

// Prints the case that broke the harness. `xxd -r -p` turns the text into a file to keep.
extern "C" void show_case(int signal) {
  std::fprintf(stderr, "signal %d in the case ", signal);
  for (const std::uint8_t byte : *running) std::fprintf(stderr, "%02x", byte);
  std::fputc('\n', stderr);
  std::_Exit(1);
}

/// Seconds that no case may take; sanitizers slow all down.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr unsigned kLongest_s = 200;
#else
constexpr unsigned kLongest_s = 20;
#endif

void run(fuzz::Harness harness, const Case& bytes) {
  running = &bytes;
  alarm(kLongest_s);
  harness(bytes.data(), bytes.size());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fprintf(stderr, "usage: %s NAME CASES MUTATIONS\n", argv[0]);
    return 2;
  }
  const auto found = fuzz::harnesses().find(argv[1]);
  if (found == fuzz::harnesses().end()) {
    std::fprintf(stderr, "%s has no harness %s.\n", argv[0], argv[1]);
    return 2;
  }
  const fuzz::Harness harness = found->second;
  const std::vector<Case> cases = cases_in(argv[2]);
  if (cases.empty()) {
    std::fprintf(stderr, "%s holds no case.\n", argv[2]);
    return 1;
  }
  for (const int signal : {SIGABRT, SIGSEGV, SIGFPE, SIGALRM}) std::signal(signal, show_case);
  for (const Case& bytes : cases) run(harness, bytes);
  bodice::engine::Random random(1);
  for (int i = std::atoi(argv[3]); i > 0; --i) {
    run(harness, mutated(cases[random.below(cases.size())], random));
  }
  std::printf("%zu cases and %s mutations of them: nothing found\n", cases.size(), argv[3]);
  return 0;
}
