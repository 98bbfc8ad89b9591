#pragma once

#include <atomic>
#include <exception>
#include <memory>
#include <utility>

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
  bool cancelled() const noexcept {
    for (const State* state = state_.get(); state; state = state->parent.get()) {
      if (state->cancelled.load(std::memory_order_relaxed)) return true;
    }
    return false;
  }
  /// Throws Cancelled if the work was cancelled.
  void check() const {
    if (cancelled()) throw Cancelled{};
  }

 private:
  friend class CancelSource;
  struct State {
    std::atomic<bool> cancelled{false};
    std::shared_ptr<const State> parent;
  };
  explicit CancelToken(std::shared_ptr<const State> state) : state_(std::move(state)) {}
  std::shared_ptr<const State> state_;
};

/// The writing side of a cancellation.
class CancelSource {
 public:
  CancelSource() : CancelSource(CancelToken{}) {}
  /// Work that is also cancelled when `parent` is.
  explicit CancelSource(const CancelToken& parent) : state_(std::make_shared<CancelToken::State>()) {
    state_->parent = parent.state_;
  }
  void cancel() noexcept { state_->cancelled.store(true, std::memory_order_relaxed); }
  CancelToken token() const { return CancelToken(state_); }

 private:
  std::shared_ptr<CancelToken::State> state_;
};

}  // namespace bodice::engine
