#define BODICE_KERNEL_TARGET HWY_SCALAR
#include "simd/dispatch/kernel-inl.hpp"
