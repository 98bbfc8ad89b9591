#include <algorithm>
#include <cmath>

#include "state.hpp"

namespace bodice::cloth {
namespace {

double edge_strain(const StretchConstraints& c, const Particles& p, std::size_t e) {
  const float dx = p.x[c.a[e]] - p.x[c.b[e]], dy = p.y[c.a[e]] - p.y[c.b[e]], dz = p.z[c.a[e]] - p.z[c.b[e]];
  return std::max(0.0, static_cast<double>(std::sqrt(dx * dx + dy * dy + dz * dz) / c.rest_m[e]) - 1.0);
}

// The q-quantile of the first `count` scratch values; reorders them.
double quantile(std::vector<float>& values, std::size_t count, double q) {
  if (count == 0) return 0.0;
  const auto at = static_cast<std::ptrdiff_t>(q * static_cast<double>(count - 1));
  std::nth_element(values.begin(), values.begin() + at, values.begin() + static_cast<std::ptrdiff_t>(count));
  return static_cast<double>(values[static_cast<std::size_t>(at)]);
}

void measure_strain(State& s, FrameReport& report) {
  for (std::size_t e = 0; e < s.stretch.count(); ++e) {
    const double strain = edge_strain(s.stretch, s.particles, e);
    s.scratch[e] = static_cast<float>(strain);
    report.stretch_max = std::max(report.stretch_max, strain);
  }
  report.stretch_p95 = quantile(s.scratch, s.stretch.count(), 0.95);
}

void measure_motion(State& s, FrameReport& report) {
  const Particles& p = s.particles;
  double kinetic = 0.0, gravity = 0.0;
  for (std::size_t i = 0; i < p.count(); ++i) {
    const float v2 = p.vx[i] * p.vx[i] + p.vy[i] * p.vy[i] + p.vz[i] * p.vz[i];
    s.scratch[i] = s.sleep.speed[i];
    const auto mass = static_cast<double>(p.mass[i]);
    kinetic += 0.5 * mass * static_cast<double>(v2);
    gravity -= mass * s.options.environment.gravity_m_s2.dot(p.world(i));
    report.finite = report.finite && std::isfinite(p.x[i] + p.y[i] + p.z[i] + v2);
  }
  report.asleep = s.sleep.asleep;
  report.kinetic_energy_j = kinetic;
  report.gravity_energy_j = gravity;
  report.elastic_energy_j = stretch_energy(s.stretch, p) + bend_energy(s.bend, p);
  report.median_speed_m_s = quantile(s.scratch, p.count(), 0.5);
}

}  // namespace

void measure(const engine::Context&, State& state, FrameReport& report) {
  measure_strain(state, report);
  measure_motion(state, report);
}

}  // namespace bodice::cloth
