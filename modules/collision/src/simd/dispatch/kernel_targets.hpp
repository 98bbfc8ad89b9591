// The instruction sets that the kernels are compiled for. It must come before the first header of Highway.
#pragma once

// All 64-bit ARM processors have NEON, and the kernels use nothing beyond it, so there is nothing to choose
// at run time. Highway reserves its name HWY_NEON for processors with AES: the build allows the compiler AES
// as well, and a test shows that no such instruction is in the kernels. Without the choice, g++ needs no
// target pragmas, under which it cannot inline the implicit members of structures of vectors.
#if defined(__aarch64__)
#define HWY_COMPILE_ONLY_STATIC
#endif
// A machine with an instruction set between these uses the next lower one. So do machines above AVX3, which
// have the bits below HWY_AVX3. Scalable vectors are excluded because they cannot be members of structures.
#define BODICE_NEVER_TARGETS \
  (HWY_SSSE3 | (HWY_AVX3 - 1) | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
// A first build is for this machine alone (BODICE_KERNELS_FOR_HOST); other processors run the scalar kernels.
#if defined(BODICE_HOST_KERNELS)
#define HWY_DISABLED_TARGETS \
  (BODICE_NEVER_TARGETS | ((HWY_SSE4 | HWY_AVX2 | HWY_AVX3) & ~BODICE_HOST_KERNELS))
#else
#define HWY_DISABLED_TARGETS BODICE_NEVER_TARGETS
#endif
// Without vectors the code runs one lane at a time, as with g++. Clang 14 would need over ten minutes to
// compile the emulated vectors that Highway offers it.
#define HWY_BROKEN_EMU128 1
