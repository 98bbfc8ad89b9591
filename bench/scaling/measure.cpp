#include "measure.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <map>
#include <memory>
#include <mutex>
#include <numeric>
#include <thread>

#include <bodice/engine/executor.hpp>

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

struct Runner {
  Sample sample;
  std::unique_ptr<Executor> executor;
  Work work;
  std::vector<double> wall_ms;
  double cpu_ms = 0.0;

  void run_once(std::uint64_t expected) {
    const Stopwatch watch;
    const std::uint64_t hash = work(Context{.executor = executor.get()});
    wall_ms.push_back(watch.wall_ms());
    cpu_ms += watch.cpu_ms();
    sample.same_bits = sample.same_bits && hash == expected;
  }

  void close() {
    sample.repeats = static_cast<int>(wall_ms.size());
    sample.cpu_ms = cpu_ms / sample.repeats;
    std::ranges::sort(wall_ms);
    sample.min_ms = wall_ms.front();
    sample.median_ms = wall_ms[wall_ms.size() / 2];
  }
};

// The worker counts take turns, so that a drift of the machine's speed meets all of them.
void run_in_turns(std::vector<Runner>& runners, const Effort& effort) {
  std::vector<std::uint64_t> expected;
  for (Runner& runner : runners) expected.push_back(runner.work(Context{}));  // also warms up
  for (int attempt = 0; attempt < effort.attempts; ++attempt) {
    for (Runner& runner : runners) runner.wall_ms.clear(), runner.cpu_ms = 0.0;
    const Stopwatch watch;
    const double limit_ms = 1e3 * effort.seconds_per_sample * static_cast<double>(runners.size());
    for (int round = 0; round < 3 || (watch.wall_ms() < limit_ms && round < 200); ++round) {
      for (std::size_t i = 0; i < runners.size(); ++i) runners[i].run_once(expected[i]);
    }
    const double others = watch.others();
    for (Runner& runner : runners) runner.sample.others = others;
    if (others <= kQuietShare) break;
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
