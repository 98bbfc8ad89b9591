// How well is every body analyzed, and in what time? Rows of the bodies that miss a bar, then every bar
// beside what was measured; --help has the arguments. The program fails if a body of a file misses a bar.
#include <cstdio>
#include <cstring>
#include <filesystem>

#include <bench_support/help.hpp>

#include "cost.hpp"
#include "measurements.hpp"
#include "report.hpp"
#include "scans.hpp"
#include "sheet.hpp"

namespace {

struct Arguments {
  std::string data = "../shared/data", only, picture, keep;
  std::uint64_t seeds = 0, rigs = 0, measured = 0, scans = 0, from = 0;
  bool all = false, verbose = false, cost = false, real = false, proxies = false;
};

Arguments parse(int argc, char** argv) {
  Arguments a;
  for (int i = 1; i < argc; ++i) {
    const auto is = [&](const char* name) { return std::strcmp(argv[i], name) == 0; };
    if (is("--all")) a.all = true;
    if (is("--verbose")) a.verbose = true;
    if (is("--cost")) a.cost = true;
    if (is("--real")) a.real = true;
    if (is("--proxies")) a.proxies = true;
    if (i + 1 >= argc) break;
    if (is("--data"))
      a.data = argv[++i];
    else if (is("--only"))
      a.only = argv[++i];
    else if (is("--seeds"))
      a.seeds = std::stoull(argv[++i]);
    else if (is("--measurements"))
      a.measured = std::stoull(argv[++i]);
    else if (is("--scans"))
      a.scans = std::stoull(argv[++i]);
    else if (is("--keep"))
      a.keep = argv[++i];
    else if (is("--rigs"))
      a.rigs = std::stoull(argv[++i]);
    else if (is("--from"))
      a.from = std::stoull(argv[++i]);
    else if (is("--sheet"))
      a.picture = argv[++i];
  }
  return a;
}

void run(const bench::Case& c, bench::Report& report, bench::Sheet& sheet) {
  const auto anatomy = bodice::anatomy::analyze({}, c.mesh, {bodice::body::find_profile("ansur2").value()});
  if (!anatomy) return report.add_refused(c, anatomy.error().sentence());
  report.add(c, *anatomy);
  sheet.add(c.mesh, *anatomy);
}

constexpr const char* kUsage =
    "anatomy [--data DIR] [--only TEXT] [--all] [--verbose] [--sheet FILE.png]    bodies of files against "
    "truth\n"
    "anatomy --seeds N [--from M]           made bodies in place of files\n"
    "anatomy --rigs N                       random poses of the files' bodies\n"
    "anatomy --measurements N [--from M]    errors of the 26 measurements of made bodies that stand\n"
    "anatomy --scans N [--from M] [--only KIND] [--keep FOLDER] [--real] [--proxies]    outcomes of made "
    "scans of each "
    "kind\n"
    "anatomy --cost                         time of the analysis\n"
    "Rows are bodies that miss a bar; --all: of every body; --verbose: with every landmark's error.\n";

}  // namespace

int main(int argc, char** argv) {
  if (bench::help_requested(argc, argv, kUsage)) return 0;
  const Arguments arguments = parse(argc, argv);
  if (arguments.measured > 0) {
    bench::print_measurement_errors(arguments.from, arguments.measured);
    return 0;
  }
  if (arguments.scans > 0) {
    if (arguments.real && !std::filesystem::is_directory(arguments.data + "/rigs")) {
      std::fprintf(stderr, "%s is no folder of bodies: name one with --data, or leave --real out\n",
                   arguments.data.c_str());
      return 2;
    }
    const bool written = bench::print_scans({.count = arguments.scans,
                                             .from = arguments.from,
                                             .only = arguments.only,
                                             .folder = arguments.keep,
                                             .data = arguments.real ? arguments.data : "",
                                             .picture = arguments.picture,
                                             .verbose = arguments.verbose,
                                             .proxies = arguments.proxies});
    return written ? 0 : 1;
  }
  if (arguments.cost) {
    bench::print_cost();
    return 0;
  }
  const bool of_rigs = arguments.rigs > 0, of_files = arguments.seeds == 0 && !of_rigs;
  const std::string needed = of_rigs ? arguments.data + "/rigs" : arguments.data;
  if ((of_rigs || of_files) && !std::filesystem::is_directory(needed)) {
    std::fprintf(stderr, "%s is no folder of bodies: name one with --data, or use made bodies with --seeds\n",
                 needed.c_str());
    return 2;
  }
  bench::Report report(arguments.all || arguments.verbose, arguments.verbose);
  bench::Sheet sheet;
  report.header();
  for (std::uint64_t i = 0; i < arguments.seeds; ++i)
    run(bench::synth_case(arguments.from + i), report, sheet);
  if (of_rigs)
    for (const bench::Case& c : bench::rig_cases(arguments.data, arguments.from, arguments.rigs))
      run(c, report, sheet);
  if (of_files)
    for (const bench::Case& c : bench::file_cases(arguments.data, arguments.only)) run(c, report, sheet);
  report.summary();
  if (!arguments.picture.empty() && !sheet.write(arguments.picture)) {
    std::fprintf(stderr, "could not write %s\n", arguments.picture.c_str());
    return 1;
  }
  return of_files && !report.holds_bars() ? 1 : 0;
}
