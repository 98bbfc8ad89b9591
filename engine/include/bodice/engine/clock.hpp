#pragma once

#include <cstdint>

namespace bodice::engine {

/// Where time comes from: traces, stage times and time budgets ask it, results never do.
class Clock {
 public:
  virtual ~Clock() = default;
  /// Nanoseconds since an arbitrary start; never goes back. Thread-safe.
  virtual std::int64_t now_ns() const noexcept = 0;
};

/// The machine's monotonic clock.
const Clock& steady_clock() noexcept;

}  // namespace bodice::engine
