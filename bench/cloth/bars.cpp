#include "bars.hpp"

#include <algorithm>
#include <cstdio>
#include <memory>
#include <utility>
#include <vector>

#include <bench_support/median.hpp>

#include "scene.hpp"

namespace bench {
namespace {

using namespace bodice;

constexpr double kFrame_s = 1.0 / 60.0;
constexpr int kWarmFrames = 30;  // until the cloth is in contact and begins to fold
constexpr int kTurns = 20;
constexpr int kTimedFramesATurn = 3;  // after one frame that fills the processor's caches again

/// A poncho in contact with the body, and the times of its frames.
class TimedCloth {
 public:
  TimedCloth(std::size_t particles, int workers)
      : executor_(engine::make_tbb_executor(workers)),
        context_{.executor = executor_.get()},
        body_(torso()),
        solver_(std::move(cloth::Solver::make(poncho(particles), {}, *cloth::find_fabric("cotton"),
                                              {.substeps = 8}))
                    .value()) {
    for (int k = 0; k < kWarmFrames; ++k) solver_.step(context_, body_, kFrame_s);
  }

  void take_turn() {
    solver_.step(context_, body_, kFrame_s);
    for (int k = 0; k < kTimedFramesATurn; ++k) {
      const cloth::FrameReport report = solver_.step(context_, body_, kFrame_s);
      ms_.push_back(1e-3 * report.frame_us);
      share_.push_back(report.collision_us / report.frame_us);
    }
  }

  double least_ms() const { return *std::ranges::min_element(ms_); }
  double median_ms() const { return bench::median(ms_); }
  double collision_share() const { return bench::median(share_); }

 private:
  std::unique_ptr<engine::Executor> executor_;
  engine::Context context_;
  collision::Collider body_;
  cloth::Solver solver_;
  std::vector<double> ms_, share_;
};

void print_row(const char* what, const char* unit, double value, double bar) {
  std::printf("%-62s %8.2f %-3s  at most %5.2f  %s\n", what, value, unit, bar, value <= bar ? "" : "MISSED");
}

}  // namespace

void print_bars() {
  TimedCloth small(10'000, 2), large(100'000, 2), alone(10'000, 1);
  // The cloths take turns, so that a slow minute affects all of them alike. Each has the same number of
  // frames, because a poncho at rest is cheaper than one that folds.
  for (int turn = 0; turn < kTurns; ++turn)
    for (TimedCloth* cloth : {&large, &small, &alone}) cloth->take_turn();
  std::printf("8 substeps, self-contact, two workers, %d frames in turns\n", kTurns * kTimedFramesATurn);
  print_row("10k particles, frame, least", "ms", small.least_ms(), 8.0);
  print_row("10k particles, frame, median", "ms", small.median_ms(), 8.0);
  print_row("10k particles, collision's share of a serial frame, median", "%", 1e2 * alone.collision_share(),
            20.0);
  print_row("100k particles, frame, median, over ten times that of 10k", "",
            0.1 * large.median_ms() / small.median_ms(), 1.25);
  std::printf("100k particles, frame: least %.1f ms, median %.1f ms\n\n", large.least_ms(),
              large.median_ms());
}

}  // namespace bench
