#include <cmath>

#include <bodice/engine/parallel.hpp>

#include "base/tolerances.hpp"
#include "solver/state.hpp"

namespace bodice::inline v0_1::cloth {
namespace {

// Sums of energies and of sleeping particles over a range of particles.
struct Motion {
  double kinetic = 0.0, gravity = 0.0;  // joules
  std::size_t asleep = 0;
  bool finite = true;
};

Motion sum_of(const Motion& a, const Motion& b) {
  return {a.kinetic + b.kinetic, a.gravity + b.gravity, a.asleep + b.asleep, a.finite && b.finite};
}

// The 95th percentile of the strain: 5 % of the edges are longer. Idle slots and shortened edges count as
// zero.
double strain_p95(const engine::Context& context, State& s) {
  const auto longer = static_cast<std::size_t>(0.05 * static_cast<double>(s.stretch.edges));
  return static_cast<double>(nth_largest(context, s.strain, longer, s.selection));
}

double median_speed(const engine::Context& context, State& s) {
  const std::size_t faster = s.particles.count() - 1 - (s.particles.count() - 1) / 2;
  return static_cast<double>(nth_largest(context, s.sleep.speed, faster, s.selection));
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
      [&](std::size_t begin, std::size_t end) { return measure_block(s, begin, end); }, sum_of);
  report.kinetic_energy_j = motion.kinetic;
  report.gravity_energy_j = motion.gravity;
  report.asleep = motion.asleep;
  report.finite = motion.finite;
}

}  // namespace

void measure(const engine::Context& context, State& s, FrameReport& report) {
  const Strain strain = measure_stretch(context, s.stretch, s.particles, s.strain);
  s.longest_strain = strain.longest;
  report.elastic_energy_j = strain.energy_j + bend_energy(context, s.bend, s.particles);
  report.stretch_max = static_cast<double>(strain.longest);
  report.stretch_p95 = strain_p95(context, s);
  report.median_speed_m_s = median_speed(context, s);
  measure_motion(context, s, report);
}

}  // namespace bodice::cloth
