#include "bars.hpp"

#include <algorithm>
#include <cstdio>
#include <vector>

#include "scene.hpp"

namespace bench {
namespace {

using namespace bodice;

constexpr double kFrame_s = 1.0 / 60.0;
constexpr int kWarmFrames = 30;  // in contact, folds begun
constexpr int kFrames = 60;

struct Times {
  double least_ms = 0.0, median_ms = 0.0;
  double collision_share = 0.0;  ///< median over the frames
};

Times time_frames(std::size_t particles, int workers) {
  const auto executor = engine::make_tbb_executor(workers);
  const engine::Context context{.executor = executor.get()};
  const collision::Collider body = torso();
  auto solver = cloth::Solver::make(poncho(particles), {}, *cloth::find_fabric("cotton"), {.substeps = 8});
  for (int k = 0; k < kWarmFrames; ++k) solver->step(context, body, kFrame_s);
  std::vector<double> ms, share;
  for (int k = 0; k < kFrames; ++k) {
    const cloth::FrameReport report = solver->step(context, body, kFrame_s);
    ms.push_back(1e-3 * report.frame_us);
    share.push_back(report.collision_us / report.frame_us);
  }
  std::ranges::sort(ms);
  std::ranges::sort(share);
  return {ms.front(), ms[ms.size() / 2], share[share.size() / 2]};
}

void print_row(const char* what, const char* unit, double value, double bar) {
  std::printf("%-62s %8.2f %-3s  at most %5.2f  %s\n", what, value, unit, bar, value <= bar ? "" : "MISSED");
}

}  // namespace

void print_bars() {
  const Times small = time_frames(10'000, 2), large = time_frames(100'000, 2), alone = time_frames(10'000, 1);
  std::printf("8 substeps, self-contact, two workers, %d frames\n", kFrames);
  print_row("10k particles, frame, least", "ms", small.least_ms, 8.0);
  print_row("10k particles, frame, median", "ms", small.median_ms, 8.0);
  print_row("10k particles, collision's share of a serial frame, median", "%", 1e2 * alone.collision_share,
            20.0);
  print_row("100k particles, frame, least, over ten times that of 10k", "",
            0.1 * large.least_ms / small.least_ms, 1.25);
  std::printf("100k particles, frame: least %.1f ms, median %.1f ms\n\n", large.least_ms, large.median_ms);
}

}  // namespace bench
