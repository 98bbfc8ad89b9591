#define BODICE_KERNEL_TARGET HWY_SCALAR
#include "simd/kernel-inl.hpp"
