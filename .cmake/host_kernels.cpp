// Prints which of the instruction sets of modules/collision/src/simd/dispatch/kernel_targets.hpp this machine
// runs, as a macro of Highway. Fails on ARM processors, where the instruction set is not chosen at run time.
#include <cstdio>

#include <hwy/targets.h>

int main() {
  const auto supported = hwy::SupportedTargets();
  if (supported & HWY_AVX3) return std::puts("HWY_AVX3") < 0;
  if (supported & HWY_AVX2) return std::puts("HWY_AVX2") < 0;
  if (supported & HWY_SSE4) return std::puts("HWY_SSE4") < 0;
  return 1;
}
