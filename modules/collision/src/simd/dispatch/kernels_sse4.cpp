#define BODICE_KERNEL_TARGET HWY_SSE4
#include "simd/dispatch/kernel-inl.hpp"
