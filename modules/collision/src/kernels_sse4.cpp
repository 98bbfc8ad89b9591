#define BODICE_KERNEL_TARGET HWY_SSE4
#include "simd/kernel-inl.hpp"
