#include "pinned.hpp"

#ifdef __linux__
#include <sched.h>
#endif

namespace bodice_bench {

#ifdef __linux__

struct Pinned::Mask {
  cpu_set_t set;
};

Pinned::Pinned(int processor) : before_(new Mask) {
  if (sched_getaffinity(0, sizeof(before_->set), &before_->set) != 0) return;
  int skip = processor % CPU_COUNT(&before_->set);
  for (int cpu = 0; cpu < CPU_SETSIZE; ++cpu) {
    if (!CPU_ISSET(cpu, &before_->set) || skip-- > 0) continue;
    cpu_set_t one;
    CPU_ZERO(&one);
    CPU_SET(cpu, &one);
    sched_setaffinity(0, sizeof(one), &one);
    return;
  }
}

Pinned::~Pinned() {
  sched_setaffinity(0, sizeof(before_->set), &before_->set);
  delete before_;
}

#else

struct Pinned::Mask {};
Pinned::Pinned(int) {}
Pinned::~Pinned() = default;

#endif

}  // namespace bodice_bench
