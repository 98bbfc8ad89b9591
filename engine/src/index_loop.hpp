#pragma once

#include <atomic>
#include <cstddef>
#include <exception>
#include <limits>
#include <mutex>
#include <span>

#include <bodice/engine/function_ref.hpp>

namespace bodice::inline v0_1::engine {

/// Consecutive indices, which are drawn in order. Several workers draw, so that it has a cache line of its
/// own.
struct alignas(64) IndexRange {
  std::atomic<std::size_t> next{0};
  std::size_t end = 0;
};

/// The indices of one bulk. Any number of threads call work(), which draws them one by one.
class IndexLoop {
 public:
  /// All workers draw from one range: bodies start in order.
  IndexLoop(std::size_t count, FunctionRef<void(std::size_t)> body) : IndexLoop(count, body, {&all_, 1}) {}

  /// Worker k draws from range k first, and from the others once that is empty. The ranges belong to this
  /// loop until every worker left.
  IndexLoop(std::size_t count, FunctionRef<void(std::size_t)> body, std::span<IndexRange> ranges)
      : body_(body), ranges_(ranges) {
    for (std::size_t k = 0; k < ranges.size(); ++k) {
      ranges[k].next.store(count * k / ranges.size(), std::memory_order_relaxed);
      ranges[k].end = count * (k + 1) / ranges.size();
    }
  }

  IndexLoop(const IndexLoop&) = delete;
  IndexLoop& operator=(const IndexLoop&) = delete;

  /// Runs bodies until no index is left to draw. Exceptions are kept for rethrow().
  void work(std::size_t worker = 0) noexcept {
    for (std::size_t k = 0; k < ranges_.size(); ++k) work_on(ranges_[(worker + k) % ranges_.size()]);
  }

  /// Throws the exception of the least index that failed; called after every worker left. All indices below a
  /// failed one are drawn, so that it does not depend on timing which exception is thrown.
  void rethrow() {
    if (exception_) std::rethrow_exception(exception_);
  }

 private:
  void work_on(IndexRange& range) noexcept {
    // In a short loop a draw that finds nothing costs as much as a body. Hence a late thread only reads the
    // counter, and the thread that draws the last index stops without a further draw.
    if (range.next.load(std::memory_order_relaxed) >= range.end) return;
    for (;;) {
      const std::size_t index = range.next.fetch_add(1, std::memory_order_relaxed);
      if (index >= range.end || index > least_failed_.load(std::memory_order_relaxed)) return;
      try {
        body_(index);
      } catch (...) {
        fail(index);
        return;
      }
      if (index + 1 == range.end) return;
    }
  }

  void fail(std::size_t index) noexcept {
    const std::lock_guard lock(mutex_);
    if (exception_ && least_failed_.load(std::memory_order_relaxed) < index) return;
    least_failed_.store(index, std::memory_order_relaxed);
    exception_ = std::current_exception();
  }

  IndexRange all_;
  const FunctionRef<void(std::size_t)> body_;
  const std::span<IndexRange> ranges_;
  std::atomic<std::size_t> least_failed_{std::numeric_limits<std::size_t>::max()};
  std::mutex mutex_;
  std::exception_ptr exception_;
};

}  // namespace bodice::engine
