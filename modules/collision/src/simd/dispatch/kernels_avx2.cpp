#define BODICE_KERNEL_TARGET HWY_AVX2
#include "simd/dispatch/kernel-inl.hpp"
