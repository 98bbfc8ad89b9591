// The choice of instruction sets at run time, in place of Highway's library, of which collision uses nothing
// else: so a program that embeds bodice needs no libhwy. Only in the shared libraries of the C interface.
#include <cstdint>
#if defined(__x86_64__) || defined(__i386__)
#include <cpuid.h>
#endif

#include <hwy/targets.h>

namespace hwy {
namespace {

#if defined(__x86_64__) || defined(__i386__)
/// Whether the processor has two extensions that __builtin_cpu_supports() of clang 16 does not know.
bool has_f16c_and_lzcnt() {
  unsigned a = 0, b = 0, c = 0, d = 0;
  if (!__get_cpuid(1, &a, &b, &c, &d) || (c & bit_F16C) == 0) return false;
  return __get_cpuid(0x80000001, &a, &b, &c, &d) && (c & bit_LZCNT) != 0;
}
#endif

/// The instruction sets of this machine among those that collision has kernels for, as Highway groups them.
std::int64_t detected() {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_cpu_init();
  std::int64_t targets = 0;
  if (!__builtin_cpu_supports("sse4.2") || !__builtin_cpu_supports("aes") ||
      !__builtin_cpu_supports("pclmul"))
    return targets;
  targets |= HWY_SSE4;
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma") || !__builtin_cpu_supports("bmi") ||
      !__builtin_cpu_supports("bmi2") || !has_f16c_and_lzcnt())
    return targets;
  targets |= HWY_AVX2;
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
      __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512cd"))
    targets |= HWY_AVX3;
  return targets;
#else
  return 0;  // what every machine of this kind has
#endif
}

}  // namespace

std::int64_t SupportedTargets() {
  static const std::int64_t targets = detected() | HWY_ENABLED_BASELINE;
  return targets;
}

ChosenTarget& GetChosenTarget() {
  static ChosenTarget chosen;
  return chosen;
}

}  // namespace hwy
