// The host's progress hook, called at the checkpoints of long work.
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>

#include <bodice/engine/context.hpp>

namespace bodice::inline v0_1::capi {

using ProgressHook = std::int32_t (*)(void* host, const char* stage);

/// An executor that calls the hook at most every 20 milliseconds, and cancels what runs on it if the hook
/// returns a number other than zero.
class Progress final : public engine::Executor {
 public:
  /// `base` is where the work runs; `hook` may be null.
  Progress(const engine::Context& base, ProgressHook hook, void* host);

  /// The context of the work: that of `base`, canceled by the hook or by cancel(). Valid as long as this.
  const engine::Context& context() const { return context_; }
  /// Names the stage that begins: a string literal.
  void stage(const char* name);
  void cancel() noexcept { cancel_.cancel(); }

  int concurrency() const noexcept override { return base_.executor->concurrency(); }
  void bulk(std::size_t count, engine::FunctionRef<void(std::size_t)> body) override {
    base_.executor->bulk(count, body);
  }
  bool start(std::shared_ptr<engine::BackgroundTask> task) override {
    return base_.executor->start(std::move(task));
  }
  void yield() noexcept override;

 private:
  void call_hook() noexcept;

  engine::Context base_, context_;
  engine::CancelSource cancel_;
  ProgressHook hook_;
  void* host_;
  std::mutex one_at_a_time_;
  std::atomic<const char*> stage_{"begin"};
  std::atomic<std::int64_t> next_ns_{0};
};

}  // namespace bodice::capi
