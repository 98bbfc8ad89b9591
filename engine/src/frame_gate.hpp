#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <limits>
#include <span>
#include <thread>
#include <vector>

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
        ranges_(static_cast<std::size_t>(frame_workers)),
        owners_(static_cast<std::size_t>(frame_workers)),
        policy_(policy),
        own_per_stay_(background_share / (1.0 - background_share)),
        clock_(clock) {}

  void begin_frame() noexcept {
    frame_thread_.store(std::this_thread::get_id(), std::memory_order_relaxed);
    epoch_.fetch_add(1);
  }
  void end_frame() noexcept { epoch_.fetch_add(1); }

  /// A loop of a frame. Each thread begins with the same share of the indices in every loop, so that what it
  /// read and wrote in the loop before is still in the cache of its processor.
  class OpenLoop {
   public:
    OpenLoop(std::size_t count, FunctionRef<void(std::size_t)> body, FrameGate& gate)
        : indices(count, body, gate.ranges_for(count)), gate_(gate), seats_(gate.seats_) {}

    void work() noexcept {
      const int left = seats_.fetch_sub(1, std::memory_order_relaxed);
      if (left > 0) indices.work(gate_.seat_of_thread(gate_.seats_ - left));
    }

    IndexLoop indices;

   private:
    FrameGate& gate_;
    std::atomic<int> seats_;
  };

  int seats() const noexcept { return seats_; }
  /// Takes the gate for one loop, until close(); false if another loop has it.
  bool take() noexcept { return !taken_.exchange(true); }
  void open(OpenLoop& loop) noexcept { open_.store(&loop); }
  /// Returns when no background thread is in the loop any more.
  void close() noexcept {
    // A visitor counts itself before it looks for the loop, while here the loop is removed before the count
    // is read. In the total order of seq_cst, a visitor that this misses finds no loop.
    open_.store(nullptr);
    for (Backoff backoff; visitors_.load() != 0;) backoff.pause();
    taken_.store(false);
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

  std::span<IndexRange> ranges_for(std::size_t count) noexcept {
    return std::span(ranges_).first(std::min(count, ranges_.size()));
  }

  // The seat that this thread has had since its first loop, or `otherwise` where others have them all.
  std::size_t seat_of_thread(int otherwise) noexcept {
    const std::thread::id self = std::this_thread::get_id();
    for (std::size_t seat = 0; seat < owners_.size(); ++seat) {
      std::thread::id owner = owners_[seat].load(std::memory_order_relaxed);
      if (owner == self) return seat;
      if (owner == std::thread::id() && owners_[seat].compare_exchange_strong(owner, self)) return seat;
    }
    return static_cast<std::size_t>(otherwise);
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
  std::vector<IndexRange> ranges_;                    // #seats
  std::vector<std::atomic<std::thread::id>> owners_;  // #seats: the thread of each, or none
  const BackgroundYield policy_;
  const double own_per_stay_;
  const Clock& clock_;
  std::atomic<std::thread::id> frame_thread_{};
  alignas(64) std::atomic<std::uint64_t> epoch_{0};  // odd while a frame runs
  alignas(64) std::atomic<OpenLoop*> open_{nullptr};
  std::atomic<bool> taken_{false};
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
    if (count <= 1 || gate_.seats() == 1 || !gate_.take()) {
      // Where the gate is taken, this loop is nested in an open one. If a helping background thread waited
      // for other threads here, it could take up background work, which would wait for this frame.
      IndexLoop loop(count, body);
      loop.work();
      loop.rethrow();
      return;
    }
    FrameGate::OpenLoop loop(count, body, gate_);
    {
      const Opening opening(gate_, loop);
      const std::size_t runners = std::min(count, static_cast<std::size_t>(gate_.seats()));
      base_.bulk(runners, [&](std::size_t) { loop.work(); });
    }
    loop.indices.rethrow();
  }

 private:
  /// Closes the gate even if the base throws, because no thread may look for a loop that is gone.
  struct Opening {
    Opening(FrameGate& taken, FrameGate::OpenLoop& loop) : gate(taken) { gate.open(loop); }
    ~Opening() { gate.close(); }
    Opening(const Opening&) = delete;
    Opening& operator=(const Opening&) = delete;
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
