#include <algorithm>
#include <cmath>

#include <bodice/engine/parallel.hpp>

#include "state.hpp"
#include "tiny.hpp"

namespace bodice::cloth {
namespace {

struct Motion {
  double kinetic = 0.0, gravity = 0.0;  // joules
  std::size_t asleep = 0;
  bool finite = true;
};

Motion add(const Motion& a, const Motion& b) {
  return {a.kinetic + b.kinetic, a.gravity + b.gravity, a.asleep + b.asleep, a.finite && b.finite};
}

// The q-quantile of values [first, first + count), which are reordered.
double quantile(std::vector<float>& values, std::size_t count, double q) {
  if (count == 0) return 0.0;
  const auto at = static_cast<std::ptrdiff_t>(q * static_cast<double>(count - 1));
  std::nth_element(values.begin(), values.begin() + at, values.begin() + static_cast<std::ptrdiff_t>(count));
  return static_cast<double>(values[static_cast<std::size_t>(at)]);
}

// Idle slots and shortened edges hold no elongation; the 95th percentile is that of the longest 5 % of edges.
void summarise_strain(State& s, FrameReport& report) {
  std::size_t longer = 0;
  for (std::size_t slot = 0; slot < s.stretch.a.size(); ++slot)
    if (s.scratch[slot] > 0.0f) s.scratch[longer++] = s.scratch[slot];
  const auto above = static_cast<std::size_t>(0.05 * static_cast<double>(s.stretch.edges));
  if (longer == 0) return;
  report.stretch_max = static_cast<double>(
      *std::max_element(s.scratch.begin(), s.scratch.begin() + static_cast<std::ptrdiff_t>(longer)));
  if (longer <= above) return;
  const auto at = s.scratch.begin() + static_cast<std::ptrdiff_t>(longer - 1 - above);
  std::nth_element(s.scratch.begin(), at, s.scratch.begin() + static_cast<std::ptrdiff_t>(longer));
  report.stretch_p95 = static_cast<double>(*at);
}

void summarise_speed(State& s, FrameReport& report) {
  std::copy(s.sleep.speed.begin(), s.sleep.speed.end(), s.speeds.begin());
  report.median_speed_m_s = quantile(s.speeds, s.particles.count(), 0.5);
}

Motion measure_block(const State& s, std::size_t begin, std::size_t end) {
  const Particles& p = s.particles;
  Motion out;
  for (std::size_t i = begin; i < end; ++i) {
    const float v2 = p.vx[i] * p.vx[i] + p.vy[i] * p.vy[i] + p.vz[i] * p.vz[i];
    const auto mass = static_cast<double>(p.mass[i]);
    out.kinetic += 0.5 * mass * static_cast<double>(v2);
    out.gravity -= mass * s.options.environment.gravity_m_s2.dot(p.world(i));
    out.asleep += sleeps(s.sleep, i);
    out.finite = out.finite && std::isfinite(p.x[i] + p.y[i] + p.z[i] + v2);
  }
  return out;
}

void measure_motion(const engine::Context& context, State& s, FrameReport& report) {
  const Motion motion = engine::ordered_reduce(
      context, s.particles.count(), reduce_grain(s.particles.count()), Motion{},
      [&](std::size_t begin, std::size_t end) { return measure_block(s, begin, end); }, add);
  report.kinetic_energy_j = motion.kinetic;
  report.gravity_energy_j = motion.gravity;
  report.asleep = motion.asleep;
  report.finite = motion.finite;
}

}  // namespace

void measure(const engine::Context& context, State& s, FrameReport& report) {
  report.elastic_energy_j =
      measure_stretch(context, s.stretch, s.particles, s.scratch) + bend_energy(context, s.bend, s.particles);
  measure_motion(context, s, report);
  // Two searches that are serial each.
  engine::parallel_for(context, 2, 1, [&](std::size_t which, std::size_t) {
    which == 0 ? summarise_strain(s, report) : summarise_speed(s, report);
  });
}

}  // namespace bodice::cloth
