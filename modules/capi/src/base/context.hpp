// The state behind a bodice_context, which every handle made in it shares.
#pragma once

#include <memory>
#include <mutex>

#include <bodice/engine/context.hpp>
#include <bodice/engine/host_executor.hpp>
#include <bodice/engine/memory_resource.hpp>

#include "base/outcome.hpp"
#include "base/thread_pool.hpp"

namespace bodice::inline v0_1::capi {

/// The host's log behind engine::Log; one call at a time, and exceptions of it are dropped.
class HostLog final : public engine::Log {
 public:
  explicit HostLog(const bodice_context_options& options) : options_(options) {}
  void write(engine::LogLevel level, std::string_view message) override;

 private:
  const bodice_context_options& options_;
  std::mutex one_at_a_time_;
};

/// The host's clock behind engine::Clock.
class HostClock final : public engine::Clock {
 public:
  explicit HostClock(const bodice_context_options& options) : options_(options) {}
  std::int64_t now_ns() const noexcept override { return options_.now_ns(options_.host); }

 private:
  const bodice_context_options& options_;
};

/// The host's memory behind engine::MemoryResource.
class HostMemory final : public engine::MemoryResource {
 public:
  explicit HostMemory(const bodice_context_options& options) : options_(options) {}
  void* allocate(std::size_t bytes, std::size_t alignment) override;
  void release(void* block, std::size_t bytes, std::size_t alignment) noexcept override;

 private:
  const bodice_context_options& options_;
};

/// Threads, log, memory and clock of a context.
class ContextState {
 public:
  static Outcome make(const bodice_context_options& options, std::shared_ptr<const ContextState>& out);
  explicit ContextState(const bodice_context_options& options);

  const bodice_context_options& options() const { return options_; }
  /// The engine's view of the context; it refers to this object.
  engine::Context engine_context() const;
  /// Memory of the host for large arrays; null: it provides none, and they lie in that of the standard
  /// library.
  engine::MemoryResource* memory() const { return options_.allocate ? &memory_ : nullptr; }

 private:
  bodice_context_options options_;
  mutable HostLog log_;
  HostClock clock_;
  mutable HostMemory memory_;
  std::unique_ptr<ThreadPool> pool_;
  std::unique_ptr<engine::Executor> executor_;  // after the pool, for it uses those threads to its end
};

using SharedContext = std::shared_ptr<const ContextState>;

/// Memory of a context for elements without constructors; it grows and never shrinks.
template <class T>
class HostArray {
 public:
  explicit HostArray(SharedContext context) : context_(std::move(context)), allocator_(context_->memory()) {}
  ~HostArray() { release(); }
  HostArray(const HostArray&) = delete;
  HostArray& operator=(const HostArray&) = delete;

  /// Room for `count` elements; their values are unspecified. Throws std::bad_alloc.
  T* reserve(std::size_t count) {
    if (count <= capacity_) return data_;
    const std::size_t capacity = count + count / 8;
    T* const block = allocator_.allocate(capacity);
    release();
    data_ = block;
    capacity_ = capacity;
    return data_;
  }
  T* data() const { return data_; }

 private:
  void release() {
    if (data_) allocator_.deallocate(data_, capacity_);
  }

  SharedContext context_;
  engine::MemoryAllocator<T> allocator_;
  T* data_ = nullptr;
  std::size_t capacity_ = 0;
};

}  // namespace bodice::capi

struct bodice_context {
  bodice::capi::SharedContext state;
};
