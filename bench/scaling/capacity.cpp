#include "capacity.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

namespace bodice_bench {
namespace {

using Clock = std::chrono::steady_clock;

double seconds(Clock::time_point begin, Clock::time_point end) {
  return std::chrono::duration<double>(end - begin).count();
}

/// About a millisecond of vector arithmetic without memory traffic.
float churn(float seed) {
  std::array<float, 64> x;
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = seed + static_cast<float>(i);
  for (int round = 0; round < 400'000; ++round)
    for (float& v : x) v = v * 0.999f + 0.25f;
  return x[0];
}

/// One run of the arithmetic, and when it began and ended.
struct Timed {
  Clock::time_point begin, end;
  volatile float sink = 0.0f;  // volatile, so that the compiler does not remove the arithmetic
  void run() {
    begin = Clock::now();
    sink = churn(sink);
    end = Clock::now();
  }
};

}  // namespace

double processors_given(int threads) {
  Timed alone;
  alone.run();
  std::vector<Timed> each(static_cast<std::size_t>(threads));
  std::atomic<int> waiting = threads;
  {
    std::vector<std::jthread> all;
    for (Timed& timed : each)
      all.emplace_back([&] {
        --waiting;
        while (waiting > 0) std::this_thread::yield();
        timed.run();
      });
  }
  const auto first = std::ranges::min(each, {}, &Timed::begin).begin;
  const auto last = std::ranges::max(each, {}, &Timed::end).end;
  return std::min<double>(threads, threads * seconds(alone.begin, alone.end) / seconds(first, last));
}

}  // namespace bodice_bench
