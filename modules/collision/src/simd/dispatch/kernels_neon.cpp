#define BODICE_KERNEL_TARGET HWY_NEON
#include "simd/dispatch/kernel-inl.hpp"
