#include "run/keep_memory.hpp"

#include <cstdlib>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace bodice::inline v0_1::cli {

void keep_freed_memory() {
#ifdef __GLIBC__
  constexpr int kKeptBytes = 256 << 20;
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, kKeptBytes);
#endif
}

}  // namespace bodice::cli
