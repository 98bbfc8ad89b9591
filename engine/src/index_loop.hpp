#pragma once

#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>

#include <bodice/engine/function_ref.hpp>

namespace bodice::inline v0_1::engine {

/// The indices of one bulk. Any number of threads call work(), which draws them one by one.
class IndexLoop {
 public:
  IndexLoop(std::size_t count, FunctionRef<void(std::size_t)> body) : count_(count), body_(body) {}

  /// Runs bodies until no index is left to draw. Exceptions are kept for rethrow().
  void work() noexcept {
    // In a short loop a draw that finds nothing costs as much as a body. Hence a late thread only reads the
    // counter, and the thread that draws the last index stops without a further draw.
    if (next_.load(std::memory_order_relaxed) >= count_) return;
    for (;;) {
      const std::size_t index = next_.fetch_add(1, std::memory_order_relaxed);
      if (index >= count_) return;
      try {
        body_(index);
      } catch (...) {
        fail(index);
        return;
      }
      if (index + 1 == count_) return;
    }
  }

  /// Throws the exception of the least index that failed; called after every worker left. Indices are drawn
  /// in order, so that all below a failed one have run too: which exception is thrown does not depend on
  /// timing.
  void rethrow() {
    if (exception_) std::rethrow_exception(exception_);
  }

 private:
  void fail(std::size_t index) noexcept {
    next_.store(count_, std::memory_order_relaxed);
    const std::lock_guard lock(mutex_);
    if (exception_ && failed_index_ < index) return;
    failed_index_ = index;
    exception_ = std::current_exception();
  }

  // Every worker draws from it, so that it has a cache line of its own.
  alignas(64) std::atomic<std::size_t> next_{0};
  alignas(64) const std::size_t count_;
  const FunctionRef<void(std::size_t)> body_;
  std::mutex mutex_;
  std::size_t failed_index_ = 0;
  std::exception_ptr exception_;
};

}  // namespace bodice::engine
