#define BODICE_KERNEL_TARGET HWY_NEON
#include "simd/kernel-inl.hpp"
