#define BODICE_KERNEL_TARGET HWY_AVX3
#include "simd/dispatch/kernel-inl.hpp"
