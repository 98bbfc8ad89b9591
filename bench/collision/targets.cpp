#include "targets.hpp"

#include <algorithm>
#include <cstdio>

#include <hwy/targets.h>

#include <bench_support/stopwatch.hpp>

namespace bench {

namespace {

/// Instruction sets that the kernels are compiled for; others fall back to scalar code.
constexpr std::int64_t kCompiled = HWY_AVX3 | HWY_AVX2 | HWY_SSE4 | HWY_NEON | HWY_SCALAR;

void use(std::int64_t targets) {
  hwy::SetSupportedTargetsForTest(targets);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

}  // namespace

void compare_targets(const std::string& name, const std::function<void()>& query, double particles,
                     int repeats) {
  double best = 0.0;
  for (std::int64_t left = hwy::SupportedTargets() & kCompiled; left != 0; left &= left - 1) {
    use(left & -left);
    double least = 1e30;
    for (int r = 0; r < repeats; ++r) {
      const Stopwatch watch;
      query();
      least = std::min(least, 1e6 * watch.cpu_ms() / particles);
    }
    // The first target is the best one.
    if (best == 0.0) best = least;
    std::printf("| %s, %s | %.1f | %.2f |\n", name.c_str(), hwy::TargetName(left & -left), least,
                least / best);
  }
  use(0);
}

}  // namespace bench
