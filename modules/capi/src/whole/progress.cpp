#include "whole/progress.hpp"

namespace bodice::inline v0_1::capi {
namespace {

constexpr std::int64_t kPause_ns = 20'000'000;

}  // namespace

Progress::Progress(const engine::Context& base, ProgressHook hook, void* host)
    : base_(base), context_(base), cancel_(base.cancel), hook_(hook), host_(host) {
  context_.cancel = cancel_.token();
  if (hook_) context_.executor = this;
}

void Progress::stage(const char* name) {
  stage_ = name;
  if (hook_) {
    const std::lock_guard lock(one_at_a_time_);
    call_hook();
  }
  context_.cancel.check();
}

void Progress::yield() noexcept {
  base_.executor->yield();
  const std::int64_t now = engine::steady_clock().now_ns();
  if (now < next_ns_.load(std::memory_order_relaxed)) return;
  const std::unique_lock lock(one_at_a_time_, std::try_to_lock);
  if (lock && now >= next_ns_.load(std::memory_order_relaxed)) call_hook();
}

void Progress::call_hook() noexcept {
  try {
    if (hook_(host_, stage_) != 0) cancel_.cancel();
  } catch (...) {  // a hook that throws can only mean that the work is not wanted
    cancel_.cancel();
  }
  next_ns_ = engine::steady_clock().now_ns() + kPause_ns;
}

}  // namespace bodice::capi
