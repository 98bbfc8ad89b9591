#include "work_span.hpp"

#include <algorithm>
#include <ctime>

#include <bodice/engine/executor.hpp>

namespace bodice_bench {
namespace {

using namespace bodice::engine;

double thread_cpu_ms() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

// What one reading costs: each block contains one, and it is no part of the stage.
double clock_cost_ms() {
  double least = 1.0;
  for (int i = 0; i < 1000; ++i) {
    const double begin = thread_cpu_ms();
    least = std::min(least, thread_cpu_ms() - begin);
  }
  return least;
}

class SerialRecorder final : public Executor {
 public:
  explicit SerialRecorder(int workers)
      : workers_(workers), clock_ms_(clock_cost_ms()), mark_ms_(thread_cpu_ms()) {}
  int concurrency() const noexcept override { return workers_; }

  void bulk(std::size_t count, FunctionRef<void(std::size_t)> body) override {
    charge();
    const WorkSpan outer = here_;
    WorkSpan loop;
    for (std::size_t i = 0; i < count; ++i) {
      here_ = {};
      body(i);
      charge();
      loop.work_ms += here_.work_ms;
      loop.span_ms = std::max(loop.span_ms, here_.span_ms);
    }
    here_ = {outer.work_ms + loop.work_ms, outer.span_ms + loop.span_ms};
  }

  WorkSpan total() {
    charge();
    return here_;
  }

 private:
  // Adds the time since the last reading to the part that is running: serial within it.
  void charge() {
    const double now_ms = thread_cpu_ms();
    const double spent_ms = std::max(0.0, now_ms - mark_ms_ - clock_ms_);
    mark_ms_ = now_ms;
    here_.work_ms += spent_ms;
    here_.span_ms += spent_ms;
  }
  int workers_;
  double clock_ms_;
  double mark_ms_;
  WorkSpan here_;
};

}  // namespace

WorkSpan measure_work_span(const Work& work, int pretended_workers) {
  work(Context{});  // warm
  SerialRecorder recorder(pretended_workers);
  work(Context{.executor = &recorder});
  return recorder.total();
}

}  // namespace bodice_bench
