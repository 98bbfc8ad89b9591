// Memory of a host for large arrays. Standard libraries of some systems that bodice runs on lack std::pmr.
#pragma once

#include <cstddef>
#include <memory>
#include <type_traits>
#include <vector>

#include <bodice/engine/version.hpp>

namespace bodice::inline v0_1::engine {

/// Memory that a host provides. Objects that are used on several threads call it from any of them.
class MemoryResource {
 public:
  virtual ~MemoryResource() = default;
  /// `bytes` of memory, aligned to `alignment`. Throws std::bad_alloc.
  virtual void* allocate(std::size_t bytes, std::size_t alignment) = 0;
  /// Takes back what allocate() gave for the same size and alignment.
  virtual void release(void* block, std::size_t bytes, std::size_t alignment) noexcept = 0;
};

/// The allocator of an array in a host's memory; without memory of a host it is that of the standard library.
template <class T>
class MemoryAllocator {
 public:
  using value_type = T;
  using propagate_on_container_move_assignment = std::true_type;
  using propagate_on_container_swap = std::true_type;

  MemoryAllocator(MemoryResource* memory = nullptr) noexcept : memory_(memory) {}
  template <class U>
  MemoryAllocator(const MemoryAllocator<U>& other) noexcept : memory_(other.memory()) {}

  T* allocate(std::size_t count) {
    if (!memory_) return std::allocator<T>().allocate(count);
    return static_cast<T*>(memory_->allocate(count * sizeof(T), alignof(T)));
  }
  void deallocate(T* first, std::size_t count) noexcept {
    if (memory_)
      memory_->release(first, count * sizeof(T), alignof(T));
    else
      std::allocator<T>().deallocate(first, count);
  }
  MemoryResource* memory() const noexcept { return memory_; }
  friend bool operator==(const MemoryAllocator&, const MemoryAllocator&) = default;

 private:
  MemoryResource* memory_;
};

/// An array in memory of a host, or of the standard library.
template <class T>
using HostedArray = std::vector<T, MemoryAllocator<T>>;

}  // namespace bodice::engine
