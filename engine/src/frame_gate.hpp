#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <limits>
#include <thread>

#include <bodice/engine/executor.hpp>
#include <bodice/engine/frame_pipeline.hpp>
#include "index_loop.hpp"

namespace bodice::inline v0_1::engine {

/// Signals the processor, and after a while the system, that this thread only waits.
class Backoff {
 public:
  void pause() noexcept {
    if (++rounds_ > kSpins) {
      std::this_thread::yield();
      return;
    }
#if defined(__x86_64__) || defined(__i386__)
    __builtin_ia32_pause();
#endif
  }

 private:
  static constexpr int kSpins = 200;  // about 10 us: longer than most gaps between loops of a frame
  int rounds_ = 0;
};

/// The frame opens its loops here, and background threads that reach a checkpoint take part in them.
class FrameGate {
 public:
  /// `background_share` in [0, 1) is the least share of its time that a background thread keeps for itself,
  /// however long the frames are.
  FrameGate(int frame_workers, BackgroundYield policy, double background_share, const Clock& clock)
      : seats_(frame_workers),
        policy_(policy),
        own_per_stay_(background_share / (1.0 - background_share)),
        clock_(clock) {}

  void begin_frame() noexcept {
    frame_thread_.store(std::this_thread::get_id(), std::memory_order_relaxed);
    epoch_.fetch_add(1);
  }
  void end_frame() noexcept { epoch_.fetch_add(1); }

  /// One loop with its number of seats. Its destructor releases the visitors.
  struct OpenLoop {
    IndexLoop indices;
    std::atomic<int> seats;
    void work() noexcept {
      if (seats.fetch_sub(1, std::memory_order_relaxed) > 0) indices.work();
    }
  };

  int seats() const noexcept { return seats_; }
  bool open(OpenLoop& loop) noexcept {
    OpenLoop* none = nullptr;
    return open_.compare_exchange_strong(none, &loop);
  }
  /// Returns when no background thread is in the loop any more.
  void close() noexcept {
    // A visitor counts itself before it looks for the loop, while here the loop is removed before the count
    // is read. In the total order of seq_cst, a visitor that this misses finds no loop.
    open_.store(nullptr);
    for (Backoff backoff; visitors_.load() != 0;) backoff.pause();
  }

  /// Handles a checkpoint of a background thread.
  void yield() noexcept {
    const std::uint64_t epoch = epoch_.load(std::memory_order_relaxed);
    const bool in_frame = epoch % 2 == 1;
    if (!in_frame || policy_ == BackgroundYield::kNone) return;
    // A job that runs on the frame's own thread must not wait for the frame to end.
    if (frame_thread_.load(std::memory_order_relaxed) == std::this_thread::get_id()) return;
    if (clock_.now_ns() < busy_until_ns_.load(std::memory_order_relaxed)) return;
    if (guests_.fetch_add(1) < seats_ - 1) stay(epoch);
    guests_.fetch_sub(1);
  }

 private:
  // Helps until the end of this frame and no other; then background work has its share of time before the
  // next stay. Where frames leave gaps, that time lies in the gap; elsewhere it keeps background work going.
  void stay(std::uint64_t epoch) noexcept {
    const std::int64_t begin_ns = clock_.now_ns();
    Backoff backoff;
    do {
      if (help()) backoff = {};
      backoff.pause();
    } while (policy_ == BackgroundYield::kStay && epoch_.load(std::memory_order_relaxed) == epoch);
    const std::int64_t end_ns = clock_.now_ns();
    const auto own_ns = static_cast<std::int64_t>(own_per_stay_ * static_cast<double>(end_ns - begin_ns));
    busy_until_ns_.store(end_ns + own_ns, std::memory_order_relaxed);
  }

  bool help() noexcept {
    if (!open_.load(std::memory_order_relaxed)) return false;
    visitors_.fetch_add(1);
    OpenLoop* const loop = open_.load();
    if (loop) loop->work();
    visitors_.fetch_sub(1);
    return loop != nullptr;
  }

  const int seats_;
  const BackgroundYield policy_;
  const double own_per_stay_;
  const Clock& clock_;
  std::atomic<std::thread::id> frame_thread_{};
  alignas(64) std::atomic<std::uint64_t> epoch_{0};  // odd while a frame runs
  alignas(64) std::atomic<OpenLoop*> open_{nullptr};
  alignas(64) std::atomic<int> visitors_{0};
  alignas(64) std::atomic<int> guests_{0};
  // All helpers stay until the same moment, so that one time serves all of them.
  std::atomic<std::int64_t> busy_until_ns_{std::numeric_limits<std::int64_t>::min()};
};

/// Runs the frame's loops on free workers of the base executor and on background threads.
class FrameExecutor final : public Executor {
 public:
  FrameExecutor(Executor& base, FrameGate& gate) : base_(base), gate_(gate) {}
  int concurrency() const noexcept override { return gate_.seats(); }

  void bulk(std::size_t count, FunctionRef<void(std::size_t)> body) override {
    FrameGate::OpenLoop loop{{count, body}, gate_.seats()};
    if (count <= 1 || gate_.seats() == 1 || !gate_.open(loop)) {
      // This loop is nested in an open loop. If a helping background thread waited for other threads here, it
      // could take up background work, which would wait for this frame.
      loop.indices.work();
    } else {
      const Closing closing(gate_);
      const std::size_t runners = std::min(count, static_cast<std::size_t>(gate_.seats()));
      base_.bulk(runners, [&](std::size_t) { loop.work(); });
    }
    loop.indices.rethrow();
  }

 private:
  /// Closes the gate even if the base throws, because no thread may look for a loop that is gone.
  struct Closing {
    explicit Closing(FrameGate& open) : gate(open) {}
    ~Closing() { gate.close(); }
    Closing(const Closing&) = delete;
    Closing& operator=(const Closing&) = delete;
    FrameGate& gate;
  };

  Executor& base_;
  FrameGate& gate_;
};

/// Runs background work on the base executor; each block lets a frame go first.
class BackgroundExecutor final : public Executor {
 public:
  BackgroundExecutor(Executor& base, FrameGate& gate) : base_(base), gate_(gate) {}
  int concurrency() const noexcept override { return base_.concurrency(); }
  void bulk(std::size_t count, FunctionRef<void(std::size_t)> body) override {
    base_.bulk(count, [&](std::size_t i) {
      gate_.yield();
      body(i);
    });
  }
  void yield() noexcept override { gate_.yield(); }

 private:
  Executor& base_;
  FrameGate& gate_;
};

}  // namespace bodice::engine
