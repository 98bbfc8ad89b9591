// A record of what ran when and on which thread; it opens in Perfetto or chrome://tracing.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include <bodice/engine/context.hpp>
#include <bodice/engine/result.hpp>

namespace bodice::inline v0_1::engine {

/// The value of an event without a number.
inline constexpr std::int64_t kNoTraceValue = std::numeric_limits<std::int64_t>::min();

/// A span of time on one thread, or an instant if begin and end are equal.
struct TraceEvent {
  static constexpr std::size_t kMaxName = 47;  ///< bytes kept of a name, so that an event is a fixed size
  char name[kMaxName + 1] = {};
  std::int64_t begin_ns = 0, end_ns = 0;  ///< nanoseconds of the context's clock
  std::int64_t value = kNoTraceValue;     ///< a frame number or count, shown as an argument
  std::thread::id thread;
};

/// A bounded record of events. Thread-safe. All memory (about 100 bytes an event) is taken at
/// construction; when it is full, later events are counted and dropped.
class Trace {
 public:
  /// Makes room for so many events.
  explicit Trace(std::size_t capacity = 1u << 16);
  ~Trace();
  Trace(const Trace&) = delete;
  Trace& operator=(const Trace&) = delete;

  /// Records an event of the calling thread; cost: one atomic increment and a copy, no allocation.
  void record(std::string_view name, std::int64_t begin_ns, std::int64_t end_ns,
              std::int64_t value = kNoTraceValue) noexcept;

  /// The number of events that were dropped because the record was full.
  std::size_t dropped() const noexcept;
  /// The finished events in order of their begin. Safe while other threads record; allocates.
  std::vector<TraceEvent> events() const;
  /// The events as Chrome trace-event JSON; threads are numbered in order of their first event.
  std::string json() const;
  /// Writes json() beside `path` and renames it there once it is whole. Fails with kWriteFailed.
  Result<void> write(const std::filesystem::path& path) const;

 private:
  struct Slot;
  std::size_t capacity_;
  std::unique_ptr<Slot[]> slots_;
  std::atomic<std::size_t> next_{0};
};

/// Records its own lifetime under a name, which must outlive it. Without a trace it costs one test of a
/// pointer.
class TraceSpan {
 public:
  TraceSpan(const Context& context, std::string_view name, std::int64_t value = kNoTraceValue) noexcept
      : trace_(context.trace), clock_(context.clock), name_(name), value_(value) {
    if (trace_) begin_ns_ = clock_->now_ns();
  }
  ~TraceSpan() {
    if (trace_) trace_->record(name_, begin_ns_, clock_->now_ns(), value_);
  }
  TraceSpan(const TraceSpan&) = delete;
  TraceSpan& operator=(const TraceSpan&) = delete;

 private:
  Trace* trace_;
  const Clock* clock_;
  std::string_view name_;
  std::int64_t value_;
  std::int64_t begin_ns_ = 0;
};

/// Records a moment, such as a publication or a cancellation.
inline void trace_instant(const Context& context, std::string_view name, std::int64_t value = kNoTraceValue) {
  if (!context.trace) return;
  const std::int64_t now_ns = context.clock->now_ns();
  context.trace->record(name, now_ns, now_ns, value);
}

}  // namespace bodice::engine
