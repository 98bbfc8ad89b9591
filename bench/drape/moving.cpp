#include "moving.hpp"

#include <cstdio>
#include <fstream>

#include <bench_support/origin.hpp>

namespace bench {
namespace {

// Bars, in the units of the columns.
constexpr double kDeepest_mm = 2.0, kRest_mm = 1.0, kDrop_mm = 100.0;

std::string missed_bars(const LongRun& run) {
  std::string missed;
  auto judge = [&](const char* name, bool holds) {
    if (!holds) missed += std::string(missed.empty() ? "  MISSED " : ", ") + name;
  };
  judge("deep", 1e3 * run.deepest_m <= kDeepest_mm);
  judge("deep at rest", 1e3 * run.rest_m <= kRest_mm);
  judge("lost", 1e3 * run.drop_m <= kDrop_mm);
  judge("hashes", run.same_hashes);
  return missed + (run.report.finite ? "" : "  NOT FINITE");
}

void print_head_of_moving() {
  std::printf("%-26s %-9s %6s %7s %7s %8s %6s %7s %8s %7s %8s %7s\n", "", "", "parti-", "ms", "ms", "mm deep",
              "at", "frames", "mm deep", "drop", "stretch", "mm off");
  std::printf("%-26s %-9s %6s %7s %7s %8s %6s %7s %8s %7s %8s %7s\n", "outfit", "motion", "cles", "median",
              "p99", "moving", "s", "> 2 mm", "at rest", "mm", "p95 %", "proxy");
  std::printf("%-26s %-9s %6s %7s %7s %8.0f %6s %7d %8.0f %7.0f\n", "  at most", "", "", "", "", kDeepest_mm,
              "", 0, kRest_mm, kDrop_mm);
}

void print_row(const MovingOutfit& outfit, const std::string& motion, const LongRun& run) {
  const bodice::tryon::DrapeReport& r = run.report;
  std::printf("%-26s %-9s %6zu %7.2f %7.2f %8.2f %6.2f %7d %8.2f %7.0f %8.2f %7.2f%s\n", outfit.name.c_str(),
              motion.c_str(), r.particles, r.frame_ms_median, r.frame_ms_p99, 1e3 * run.deepest_m,
              run.deepest_s, run.frames_over_2mm, 1e3 * run.rest_m, 1e3 * run.drop_m, 1e2 * r.stretch_p95,
              run.proxy_mm, missed_bars(run).c_str());
  print_deep_particles(run.deep);
  std::fflush(stdout);
}

void add_depths(const MovingOutfit& outfit, const std::string& motion, const LongRun& run,
                std::ofstream& csv) {
  const auto& depths = run.report.penetration_of_frame_m;
  for (std::size_t i = 0; i < depths.size(); ++i)
    csv << outfit.name << ',' << motion << ',' << i + 1 << ',' << 1e3 * depths[i] << '\n';
}

}  // namespace

bool drape_moving(const bodice::engine::Context& context, MovingOptions options) {
  std::ofstream csv;
  if (!options.out.empty()) {
    std::filesystem::create_directories(options.out);
    csv.open(options.out / "depths.csv");
    csv << "outfit,motion,frame,deepest_mm\n";
  }
  std::printf("%s\n", title(find_origin()).c_str());
  print_head_of_moving();
  bool written = true;
  for (const MovingOutfit& outfit : moving_outfits(context, options.data, options.only))
    for (const std::string& motion : options.motions) {
      options.run.motion = motion;
      const LongRun run = run_long(context, outfit, options.run);
      print_row(outfit, motion, run);
      if (options.out.empty()) continue;
      add_depths(outfit, motion, run, csv);
      written = write_sheet(outfit, run, options.out / (outfit.name + "_" + motion + ".png")) && written;
    }
  if (!options.out.empty()) written = written && csv.good();
  return written;
}

}  // namespace bench
