#pragma once

#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>

#include <bodice/engine/function_ref.hpp>

namespace bodice::engine {

/// The indices of one bulk, drawn one by one by however many threads call work().
class IndexLoop {
 public:
  IndexLoop(std::size_t count, FunctionRef<void(std::size_t)> body) : count_(count), body_(body) {}

  /// Runs bodies until no index is left to draw. Exceptions are kept for rethrow().
  void work() noexcept {
    // In a short loop a draw that finds nothing costs as much as a body: one who comes late only looks, and
    // who draws the last index knows that it is the last.
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

  /// After every worker left: throws the exception of the least index that failed. Indices are drawn in
  /// order, so each one below a failed one has run too, and which exception wins does not depend on timing.
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

  // Drawn from by every worker, so it keeps the cache line to itself.
  alignas(64) std::atomic<std::size_t> next_{0};
  alignas(64) const std::size_t count_;
  const FunctionRef<void(std::size_t)> body_;
  std::mutex mutex_;
  std::size_t failed_index_ = 0;
  std::exception_ptr exception_;
};

}  // namespace bodice::engine
