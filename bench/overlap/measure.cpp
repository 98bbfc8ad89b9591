#include "measure.hpp"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <fstream>
#include <thread>

#include <unistd.h>

namespace bodice_bench {
namespace {

using namespace bodice::engine;
using Clock = std::chrono::steady_clock;

double ms_since(Clock::time_point begin) {
  return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

/// Busy seconds of all processors since the machine started, stolen time included (Linux; 0 elsewhere).
double machine_busy_s() {
  std::ifstream file("/proc/stat");
  std::string cpu;
  double user = 0, nice = 0, system = 0, idle = 0, iowait = 0, irq = 0, softirq = 0, steal = 0;
  file >> cpu >> user >> nice >> system >> idle >> iowait >> irq >> softirq >> steal;
  return (user + nice + system + irq + softirq + steal) / static_cast<double>(sysconf(_SC_CLK_TCK));
}

double own_cpu_s() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

double quantile(const std::vector<double>& sorted, double q) {
  return sorted[std::min(sorted.size() - 1,
                         static_cast<std::size_t>(q * static_cast<double>(sorted.size())))];
}

/// Sets the statistics of the frames.
void summarize(std::vector<double> frame_ms, Row& row) {
  row.frames = frame_ms.size();
  std::ranges::sort(frame_ms);
  row.p50_ms = quantile(frame_ms, 0.5);
  row.p99_ms = quantile(frame_ms, 0.99);
  row.max_ms = frame_ms.back();
}

}  // namespace

Row measure(const Condition& condition, Workload& work, Executor& executor, double least_s, Trace* trace) {
  const Context context{.executor = &executor, .trace = trace};
  FramePipeline pipeline(context, {.frame_workers = condition.frame_workers, .yield = condition.yield});
  Stream<int> proxy(pipeline);
  std::vector<double> frame_ms;
  frame_ms.reserve(1 << 16);
  for (int i = 0; i < 20; ++i) pipeline.frame([&](const Context& c) { work.frame(c); });

  const double busy_before = machine_busy_s(), own_before = own_cpu_s();
  const Clock::time_point begin = Clock::now();
  Ticket ticket;
  auto submit = [&] {
    if (condition.foreground) return;
    ticket = proxy.submit("fit a body", [&work](const Context& c, Sink<int>& out) {
      int level = 0;
      return work.prepare(c, [&] {
        trace_instant(c, "published", ++level);
        out.publish(std::make_shared<const int>(level));
      });
    });
  };
  if (condition.fit) submit();
  Row row;
  row.name = condition.name;
  Clock::time_point next = Clock::now();
  const auto period = std::chrono::duration_cast<Clock::duration>(
      std::chrono::duration<double>(condition.frames_per_s > 0 ? 1.0 / condition.frames_per_s : 0.0));
  for (bool over = false; !over;) {
    const bool fitted = !condition.fit || condition.foreground || ticket.done();
    over = fitted && ms_since(begin) > 1000 * least_s;
    if (condition.fit && fitted && !condition.foreground) {
      if (++row.fits == 1) row.fit_ms = ms_since(begin);
      if (!over) submit();
    }
    const bool fit_now = condition.foreground && row.fits == 0 && ms_since(begin) > 500 * least_s;
    const FrameTiming report = pipeline.frame([&](const Context& c) {
      if (fit_now) static_cast<void>(work.prepare(c, [] {}));
      work.frame(c);
    });
    if (fit_now) {
      row.fits = 1;
      row.fit_ms = row.first_result_ms = row.last_result_ms = static_cast<double>(report.body_ns) * 1e-6;
    }
    frame_ms.push_back(static_cast<double>(report.boundary_ns + report.body_ns) * 1e-6);
    if (report.results_taken > 0 && row.fits <= 1) {
      row.last_result_ms = ms_since(begin);
      if (row.first_result_ms == 0.0) row.first_result_ms = row.last_result_ms;
    }
    if (condition.frames_per_s > 0) {
      next = std::max(next + period, Clock::now());
      std::this_thread::sleep_until(next);
    }
  }
  const double wall_s = ms_since(begin) * 1e-3;
  const double others_s = machine_busy_s() - busy_before - (own_cpu_s() - own_before);
  row.other_load = std::max(0.0, others_s / (wall_s * std::thread::hardware_concurrency()));
  summarize(std::move(frame_ms), row);
  return row;
}

double foreground_fit_ms(const Workload& work, Executor& executor) {
  const Clock::time_point begin = Clock::now();
  static_cast<void>(work.prepare(Context{.executor = &executor}, [] {}));
  return ms_since(begin);
}

}  // namespace bodice_bench
