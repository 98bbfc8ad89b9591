#include <chrono>
#include <cmath>
#include <cstdint>
#include <vector>

#include <bodice/engine/parallel.hpp>
#include <bodice/engine/random.hpp>
#include "workload.hpp"

namespace bodice_bench {
namespace {

using namespace bodice::engine;

/// Arithmetic without memory traffic; a thousand rounds take about a microsecond.
double churn(double x, int rounds) {
  for (int i = 0; i < rounds; ++i) x = std::fma(x, 0.999, 0.001) / (1.0 + 1e-3 * x);
  return x;
}

double rounds_per_us() {
  using SteadyClock = std::chrono::steady_clock;
  double best = 0.0;
  volatile double sink = 0.5;
  for (int i = 0; i < 5; ++i) {
    const auto begin = SteadyClock::now();
    sink = churn(sink, 200'000);
    const std::chrono::duration<double, std::micro> spent = SteadyClock::now() - begin;
    best = std::max(best, 200'000 / spent.count());
  }
  return best;
}

class Synthetic final : public Workload {
 public:
  explicit Synthetic(double slice_us)
      : slice_us_(slice_us),
        slice_rounds_(static_cast<int>(slice_us * rounds_per_us())),
        particles_(20'000, 0.5) {}

  std::string describe() const override {
    return "synthetic: 20k particles, 8 x 3 loops a frame; background blocks of " +
           std::to_string(static_cast<int>(slice_us_)) + " us";
  }

  void frame(const Context& context) override {
    for (int loop = 0; loop < 24; ++loop) {
      parallel_for(context, particles_.size(), 512, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) particles_[i] = churn(particles_[i], 4);
      });
    }
  }

  Result<void> prepare(const Context& context, FunctionRef<void()> publish) const override {
    std::vector<double> out(64, 0.5);
    const int levels = 8, loops = static_cast<int>(1.0e6 / slice_us_ / 64 / levels);  // one second of work
    for (int level = 0; level < levels; ++level) {
      for (int loop = 0; loop < loops; ++loop) {
        parallel_for(context, out.size(), 1,
                     [&](std::size_t i, std::size_t) { out[i] = churn(out[i], slice_rounds_); });
      }
      out[0] = churn(out[0], 10 * slice_rounds_);
      publish();
    }
    return {};
  }

 private:
  double slice_us_;
  int slice_rounds_;
  std::vector<double> particles_;
};

}  // namespace

std::unique_ptr<Workload> make_synthetic(double slice_us) {
  return std::make_unique<Synthetic>(slice_us);
}

}  // namespace bodice_bench
