// Processor time as a clock, for work on one thread: other programs on a busy machine do not add to it.
#pragma once

#include <ctime>

#include <bodice/engine/context.hpp>

namespace paper_bench {

/// The processor time of this process.
class CpuClock final : public bodice::engine::Clock {
 public:
  std::int64_t now_ns() const noexcept override {
    std::timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
  }
  double ms_since(std::int64_t begin_ns) const { return 1e-6 * static_cast<double>(now_ns() - begin_ns); }
};

}  // namespace paper_bench
