#pragma once

#include <cstddef>

namespace bodice_test {

/// False under sanitizers, which bring their own allocator.
bool counts_allocations() noexcept;

/// Calls of malloc and its relatives in this program so far, on all threads, in all libraries.
std::size_t allocations() noexcept;

}  // namespace bodice_test
