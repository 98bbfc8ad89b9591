#pragma once

#include <atomic>
#include <exception>
#include <memory>
#include <utility>

#include <bodice/engine/version.hpp>

namespace bodice::inline v0_1::engine {

/// Thrown by parallel_for and by check() in canceled work. Public functions return ErrorCode::kCanceled
/// instead.
struct Canceled : std::exception {
  const char* what() const noexcept override { return "canceled"; }
};

/// The reading side of a cancellation. It is copyable and thread-safe; a default-constructed token is never
/// canceled.
class CancelToken {
 public:
  CancelToken() = default;
  bool canceled() const noexcept {
    for (const State* state = state_.get(); state; state = state->parent.get()) {
      if (state->canceled.load(std::memory_order_relaxed)) return true;
    }
    return false;
  }
  /// Throws Canceled if the work was canceled.
  void check() const {
    if (canceled()) throw Canceled{};
  }

 private:
  friend class CancelSource;
  struct State {
    std::atomic<bool> canceled{false};
    std::shared_ptr<const State> parent;
  };
  explicit CancelToken(std::shared_ptr<const State> state) : state_(std::move(state)) {}
  std::shared_ptr<const State> state_;
};

/// The writing side of a cancellation.
class CancelSource {
 public:
  CancelSource() : CancelSource(CancelToken{}) {}
  /// Makes a source that is also canceled when `parent` is.
  explicit CancelSource(const CancelToken& parent) : state_(std::make_shared<CancelToken::State>()) {
    state_->parent = parent.state_;
  }
  void cancel() noexcept { state_->canceled.store(true, std::memory_order_relaxed); }
  CancelToken token() const { return CancelToken(state_); }

 private:
  std::shared_ptr<CancelToken::State> state_;
};

}  // namespace bodice::engine
