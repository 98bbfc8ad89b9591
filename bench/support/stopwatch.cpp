#include "bench_support/stopwatch.hpp"

#include <chrono>
#include <ctime>

namespace bench {
namespace {

double now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double own_cpu_s() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

}  // namespace

Stopwatch::Stopwatch() : wall_(now_s()), cpu_(own_cpu_s()) {}
double Stopwatch::wall_ms() const {
  return 1e3 * (now_s() - wall_);
}
double Stopwatch::cpu_ms() const {
  return 1e3 * (own_cpu_s() - cpu_);
}

}  // namespace bench
