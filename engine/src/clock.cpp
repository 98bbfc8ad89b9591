#include <bodice/engine/clock.hpp>

#include <chrono>

namespace bodice::inline v0_1::engine {
namespace {

class SteadyClock final : public Clock {
 public:
  std::int64_t now_ns() const noexcept override {
    const auto since_start = std::chrono::steady_clock::now().time_since_epoch();
    return std::chrono::duration_cast<std::chrono::nanoseconds>(since_start).count();
  }
};

}  // namespace

const Clock& steady_clock() noexcept {
  // The clock has no state, so that sharing it shares nothing.
  static const SteadyClock clock;
  return clock;
}

}  // namespace bodice::engine
