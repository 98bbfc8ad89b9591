// The kernels for the compiler's baseline instruction set, if no other file has it.
#include "simd/dispatch/kernel_targets.hpp"
// The instruction set must be known before it can be compared.
#include <hwy/detect_targets.h>

#if HWY_STATIC_TARGET & ~(HWY_SCALAR | HWY_SSE4 | HWY_AVX2 | HWY_AVX3 | HWY_NEON)
#define BODICE_KERNEL_TARGET HWY_STATIC_TARGET
#include "simd/dispatch/kernel-inl.hpp"
#endif
