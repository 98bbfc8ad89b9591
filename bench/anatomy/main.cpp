// anatomy [--data DIR] [--only TEXT] [--seeds N] [--verbose] [--sheet FILE.png]: a table of how well
// every body is understood.
#include <cstdio>
#include <cstring>

#include "score.hpp"
#include "sheet.hpp"

namespace {

void print_row(const bench::Case& c, const bodice::anatomy::Anatomy& a, const bench::Score& s, bool verbose) {
  double ms = 0.0;
  for (const auto& stage : a.stages) ms += stage.ms;
  std::printf("%-42s %7zu %7.2f %6.2f %6.2f %-12s %6.3f %7.2f", c.name.c_str(), c.mesh.positions.size(),
              100.0 * s.agreement, 100.0 * s.swapped, 100.0 * s.worst_landmark, s.worst_name.c_str(),
              s.stature_ratio, ms);
  for (const auto& w : a.warnings) std::printf(" %s(%s)", w.code.c_str(), w.part.c_str());
  std::printf("\n");
  if (!verbose) return;
  for (const auto& [name, error] : s.error) std::printf("    %s %.2f", name.c_str(), 100.0 * error);
  std::printf("\n");
}

void run(const bench::Case& c, bool verbose, bench::Sheet& sheet) {
  const auto anatomy = bodice::anatomy::analyse({}, c.mesh, {bodice::body::find_profile("ansur2").value()});
  if (!anatomy) {
    std::printf("%-42s %s\n", c.name.c_str(), anatomy.error().sentence().c_str());
    return;
  }
  print_row(c, *anatomy, bench::score(c, *anatomy), verbose);
  sheet.add(c, *anatomy);
}

}  // namespace

int main(int argc, char** argv) {
  std::string data = "../shared/data", only, picture;
  std::uint64_t seeds = 0;
  bool verbose = false;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--data") == 0 && i + 1 < argc) data = argv[++i];
    if (std::strcmp(argv[i], "--only") == 0 && i + 1 < argc) only = argv[++i];
    if (std::strcmp(argv[i], "--seeds") == 0 && i + 1 < argc) seeds = std::stoull(argv[++i]);
    if (std::strcmp(argv[i], "--sheet") == 0 && i + 1 < argc) picture = argv[++i];
    if (std::strcmp(argv[i], "--verbose") == 0) verbose = true;
  }
  std::printf("%-42s %7s %7s %6s %6s %-12s %6s %7s\n", "body", "V", "agree%", "swap%", "worst%", "landmark",
              "height", "ms");
  bench::Sheet sheet;
  for (std::uint64_t seed = 0; seed < seeds; ++seed) run(bench::synth_case(seed), verbose, sheet);
  if (seeds == 0)
    for (const bench::Case& c : bench::file_cases(data, only)) run(c, verbose, sheet);
  if (!picture.empty() && !sheet.write(picture)) {
    std::fprintf(stderr, "could not write %s\n", picture.c_str());
    return 1;
  }
  return 0;
}
