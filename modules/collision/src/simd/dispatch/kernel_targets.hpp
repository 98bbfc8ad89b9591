// The instruction sets that the kernels are compiled for. Must come before the first header of Highway.
#pragma once

// A machine whose instruction set lies between these uses the next lower one, and so do machines above AVX3,
// whose bits lie below its own. Scalable vectors cannot be members of structures.
#define HWY_DISABLED_TARGETS \
  (HWY_SSSE3 | (HWY_AVX3 - 1) | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
// Without vectors the code runs one lane at a time, as with g++. The emulated vectors that Highway offers
// clang take clang 14 over ten minutes to compile.
#define HWY_BROKEN_EMU128 1
