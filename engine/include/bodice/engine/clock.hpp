#pragma once

#include <cstdint>

#include <bodice/engine/version.hpp>

namespace bodice::inline v0_1::engine {

/// The source of time for traces, stage times and time budgets. Results do not depend on it.
class Clock {
 public:
  virtual ~Clock() = default;
  /// The nanoseconds since an arbitrary start; they never go back. Thread-safe.
  virtual std::int64_t now_ns() const noexcept = 0;
};

/// The machine's monotonic clock.
const Clock& steady_clock() noexcept;

}  // namespace bodice::engine
