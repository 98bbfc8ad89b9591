#include "measure.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <numeric>
#include <optional>
#include <thread>

#include <bodice/engine/executor.hpp>

#include "capacity.hpp"
#include "pinned.hpp"

namespace bodice_bench {
namespace {

using namespace bodice::engine;

// Adds up how long each thread is inside bodies of outermost loops.
class BusyTimes final : public Executor {
 public:
  explicit BusyTimes(Executor& base) : base_(base) {}
  int concurrency() const noexcept override { return base_.concurrency(); }
  void bulk(std::size_t count, FunctionRef<void(std::size_t)> body) override {
    base_.bulk(count, [&](std::size_t i) {
      const auto self = std::this_thread::get_id();
      const bool outermost = enter(self);
      const auto begin = std::chrono::steady_clock::now();
      body(i);
      const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
      if (outermost) leave(self, spent.count());
    });
  }
  double imbalance() const {
    double most = 0.0, sum = 0.0;
    for (const auto& [thread, busy] : busy_) {
      most = std::max(most, busy.seconds);
      sum += busy.seconds;
    }
    return sum > 0.0 ? most * base_.concurrency() / sum : 1.0;
  }

 private:
  struct Busy {
    double seconds = 0.0;
    bool inside = false;
  };
  bool enter(std::thread::id self) {
    const std::lock_guard lock(mutex_);
    return !std::exchange(busy_[self].inside, true);
  }
  void leave(std::thread::id self, double seconds) {
    const std::lock_guard lock(mutex_);
    busy_[self].inside = false;
    busy_[self].seconds += seconds;
  }
  Executor& base_;
  std::mutex mutex_;
  std::map<std::thread::id, Busy> busy_;
};

struct Run {
  double wall_ms, cpu_ms, processors;
  int on;  // which processor, of those that take turns
};

// One worker has the processors in turn: where the host lends unequal ones (measured: 55 and 79 ms for the
// same work), the pace of a single one is their mean, not that of the one it happened to have.
double pace_ms(const std::vector<Run>& runs, int turns) {
  std::vector<double> least(static_cast<std::size_t>(turns), std::numeric_limits<double>::infinity());
  for (const Run& run : runs) {
    double& best = least[static_cast<std::size_t>(run.on)];
    best = std::min(best, run.wall_ms);
  }
  double rates = 0.0, seen = 0.0;
  for (const double ms : least)
    if (std::isfinite(ms)) rates += 1.0 / ms, ++seen;
  return seen / rates;
}

struct Runner {
  Sample sample;
  std::unique_ptr<Executor> executor;
  Work work;
  std::vector<Run> runs;
  int turns = 1, bursts = 0;  ///< processors that a single worker has in turn

  /// Capacity is probed on both sides of a few milliseconds of runs; the worse of the two counts.
  void run_burst(std::uint64_t expected) {
    constexpr double kBurst_ms = 10.0;
    const double before = processors_given(sample.workers);
    const std::size_t first = runs.size();
    const int on = bursts++ % turns;
    {
      std::optional<Pinned> pinned;
      if (turns > 1) pinned.emplace(on);
      const Stopwatch burst;
      do {
        const Stopwatch watch;
        const std::uint64_t hash = work(Context{.executor = executor.get()});
        runs.push_back({watch.wall_ms(), watch.cpu_ms(), before, on});
        sample.same_bits = sample.same_bits && hash == expected;
      } while (burst.wall_ms() < kBurst_ms);
    }
    const double after = processors_given(sample.workers);
    for (std::size_t i = first; i < runs.size(); ++i) runs[i].processors = std::min(before, after);
  }

  bool fair(const Run& run) const { return run.processors >= kFairShare * sample.workers; }
  double fair_ms() const {
    double sum = 0.0;
    for (const Run& run : runs) sum += fair(run) ? run.wall_ms : 0.0;
    return sum;
  }

  void close() {
    // Where the machine never gave what it has: the best that it gave.
    double enough = kFairShare * sample.workers, best = 0.0;
    for (const Run& run : runs) best = std::max(best, run.processors);
    enough = std::min(enough, best - 0.05);
    std::erase_if(runs, [&](const Run& run) { return run.processors < enough; });
    std::ranges::sort(runs, {}, &Run::wall_ms);
    sample.repeats = static_cast<int>(runs.size());
    sample.min_ms = pace_ms(runs, turns);
    sample.median_ms = runs[runs.size() / 2].wall_ms;
    for (const Run& run : runs) {
      sample.cpu_ms += run.cpu_ms / sample.repeats;
      sample.processors += run.processors / sample.repeats;
    }
  }
};

// The worker counts take turns, so that a drift of the machine's speed meets all of them.
void run_in_turns(std::vector<Runner>& runners, const Effort& effort) {
  constexpr int kLeast = 3, kMost = 400;  // bursts
  std::vector<std::uint64_t> expected;
  for (Runner& runner : runners) expected.push_back(runner.work(Context{}));  // also warms up
  const double wanted_ms = 1e3 * effort.seconds_per_sample;
  const double limit_ms = effort.patience * wanted_ms * static_cast<double>(runners.size());
  const Stopwatch watch;
  for (int burst = 0; burst < kMost; ++burst) {
    const bool enough = std::ranges::all_of(runners, [&](auto& r) { return r.fair_ms() >= wanted_ms; });
    if (burst >= kLeast && (enough || watch.wall_ms() > limit_ms)) break;
    for (std::size_t i = 0; i < runners.size(); ++i)
      if (burst < kLeast || runners[i].fair_ms() < wanted_ms) runners[i].run_burst(expected[i]);
  }
}

std::vector<Sample> measure(const Stage& stage, std::size_t size, bool weak, const Effort& effort) {
  std::vector<Runner> runners;
  Work shared;
  for (const int workers : worker_counts(effort.max_workers)) {
    const std::size_t grown = weak ? size * static_cast<std::size_t>(workers) : size;
    if (weak || !shared) shared = stage.make(grown);
    Runner runner;
    runner.sample = {
        .stage = stage.name, .element = stage.element, .weak = weak, .size = grown, .workers = workers};
    runner.executor = make_tbb_executor(workers);
    runner.work = shared;
    if (workers == 1) runner.turns = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
    runners.push_back(std::move(runner));
  }
  run_in_turns(runners, effort);
  std::vector<Sample> samples;
  for (Runner& runner : runners) {
    runner.close();
    BusyTimes busy(*runner.executor);
    runner.work(Context{.executor = &busy});
    runner.sample.imbalance = busy.imbalance();
    samples.push_back(runner.sample);
  }
  return samples;
}

}  // namespace

std::vector<int> worker_counts(int max_workers) {
  std::vector<int> counts;
  for (int workers = 1; workers < max_workers; workers += workers < 4 ? 1 : workers)
    counts.push_back(workers);
  counts.push_back(max_workers);
  return counts;
}

std::vector<Sample> strong_scaling(const Stage& stage, std::size_t size, const Effort& effort) {
  return measure(stage, size, false, effort);
}

std::vector<Sample> weak_scaling(const Stage& stage, std::size_t size, const Effort& effort) {
  return measure(stage, size, true, effort);
}

double serial_fraction(const std::vector<Sample>& samples) {
  // With u = 1 - 1/n and t = T(n)/T(1): t - 1/n = s u.
  double above = 0.0, below = 0.0;
  for (const Sample& sample : samples) {
    const double inverse = 1.0 / sample.workers, u = 1.0 - inverse;
    above += u * (sample.min_ms / samples.front().min_ms - inverse);
    below += u * u;
  }
  return below > 0.0 ? above / below : 0.0;
}

}  // namespace bodice_bench
