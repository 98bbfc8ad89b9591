#pragma once

#include <atomic>
#include <exception>
#include <memory>

namespace bodice::engine {

/// Thrown by parallel_for and by check() when the work was cancelled; public functions turn it into
/// ErrorCode::kCancelled.
struct Cancelled : std::exception {
  const char* what() const noexcept override { return "cancelled"; }
};

/// The reading side of a cancellation. Default-constructed: never cancelled. Copyable, thread-safe.
class CancelToken {
 public:
  CancelToken() = default;
  bool cancelled() const noexcept { return flag_ && flag_->load(std::memory_order_relaxed); }
  /// Throws Cancelled if the work was cancelled.
  void check() const {
    if (cancelled()) throw Cancelled{};
  }

 private:
  friend class CancelSource;
  explicit CancelToken(std::shared_ptr<std::atomic<bool>> flag) : flag_(std::move(flag)) {}
  std::shared_ptr<std::atomic<bool>> flag_;
};

/// The writing side of a cancellation.
class CancelSource {
 public:
  CancelSource() : flag_(std::make_shared<std::atomic<bool>>(false)) {}
  void cancel() noexcept { flag_->store(true, std::memory_order_relaxed); }
  CancelToken token() const { return CancelToken(flag_); }

 private:
  std::shared_ptr<std::atomic<bool>> flag_;
};

}  // namespace bodice::engine
