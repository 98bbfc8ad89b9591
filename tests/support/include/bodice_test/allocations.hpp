// Counts a program's allocations, for tests that link bodice_test_allocations.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace bodice_test {

/// Whether allocations are counted; false under sanitizers, which have their own allocator.
bool counts_allocations() noexcept;

/// The number of calls of malloc and its relatives so far, on all threads and in all libraries.
std::size_t allocations() noexcept;

/// The fewest allocations in any of several rounds of `calls` calls, after one to warm up. On a busy machine
/// a worker may join for the first time in a later round, for which TBB allocates. Allocations of the calls
/// themselves recur in each round.
template <class Work>
std::size_t allocations_when_warm(int calls, Work&& work) {
  std::size_t fewest = SIZE_MAX;
  for (int round = 0; round < 100 && fewest > 0; ++round) {
    const std::size_t before = allocations();
    for (int i = 0; i < calls; ++i) work();
    if (round > 0) fewest = std::min(fewest, allocations() - before);
  }
  return fewest;
}

}  // namespace bodice_test
