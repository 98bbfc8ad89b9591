#define BODICE_KERNEL_TARGET HWY_AVX3
#include "simd/kernel-inl.hpp"
