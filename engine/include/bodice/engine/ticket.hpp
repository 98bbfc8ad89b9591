#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include <bodice/engine/context.hpp>
#include <bodice/engine/result.hpp>

namespace bodice::inline v0_1::engine {

/// A piece of work that runs once: on a worker, or on the thread that waits for it if no worker has begun it.
class Job final : public BackgroundTask {
 public:
  using Work = std::function<Result<void>(Job&, const Context&)>;

  /// The work is canceled when the context is, or by cancel().
  Job(std::string name, const Context& context, Work work);

  const char* name() const noexcept override { return name_.c_str(); }
  /// Runs the work unless another thread has begun it. An exception becomes an error of kInternal.
  void run() noexcept override;

  /// Requests the work to stop, which it does at its next checkpoint.
  void cancel() noexcept { cancel_.cancel(); }
  bool canceled() const noexcept { return cancel_.token().canceled(); }
  CancelToken token() const { return cancel_.token(); }
  bool done() const noexcept { return stage_.load(std::memory_order_acquire) == Stage::kDone; }
  /// Runs the work on this thread if it has not begun; returns when it is done.
  void wait() noexcept;
  /// The outcome of the work. Precondition: done().
  const Result<void>& result() const noexcept { return result_; }

  /// The number of publications and of the end, for waiting without polling.
  std::uint32_t events() const noexcept { return events_.load(std::memory_order_acquire); }
  /// Waits while events() is `seen`.
  void wait_for_event_after(std::uint32_t seen) const noexcept { events_.wait(seen); }
  /// Counts an event and wakes the threads that wait for it.
  void signal() noexcept;

 private:
  /// The states of the work, in this order.
  enum class Stage { kWaiting, kRunning, kDone };
  Result<void> call() noexcept;

  std::string name_;
  Context context_;
  CancelSource cancel_;
  Work work_;
  Result<void> result_;
  std::atomic<Stage> stage_{Stage::kWaiting};
  std::atomic<std::uint32_t> events_{0};
};

/// The caller's handle to submitted work. It is copyable; destroying it neither cancels nor waits.
class Ticket {
 public:
  Ticket() = default;
  explicit Ticket(std::shared_ptr<Job> job) : job_(std::move(job)) {}

  /// Requests the work to stop. From this call on nothing of it takes effect any more.
  void cancel() noexcept {
    if (job_) job_->cancel();
  }
  /// Whether the work is over, and so for a ticket without work. Never waits.
  bool done() const noexcept { return !job_ || job_->done(); }
  /// Waits until the work is over and returns its error, kCanceled if it was stopped, or success. Must not be
  /// called in a frame.
  Result<void> wait() const {
    if (!job_) return {};
    job_->wait();
    return job_->result();
  }

 private:
  std::shared_ptr<Job> job_;
};

}  // namespace bodice::engine
