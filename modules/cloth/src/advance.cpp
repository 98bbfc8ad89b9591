// One frame: substeps of predict, solve, contact.
// Based on: Miles Macklin, Kier Storey, Michelle Lu, Pierre Terdiman, Nuttapong Chentanez, Stefan Jeschke,
// Matthias Mueller. Small Steps in Physics Simulation. 2019. - algorithm 1
#include <algorithm>
#include <atomic>
#include <cmath>

#include <bodice/engine/parallel.hpp>

#include "pack.hpp"
#include "state.hpp"

namespace bodice::cloth {
namespace {

struct Plan {
  int substeps = 0;
  float substep_s = 0.0f;
  double simulated_s = 0.0;
  std::uint32_t limits = 0;
};

float fastest(const Particles& p) {
  float v2 = 0.0f;
  for (std::size_t i = 0; i < p.count(); ++i) {
    v2 = std::max(v2, p.vx[i] * p.vx[i] + p.vy[i] * p.vy[i] + p.vz[i] * p.vz[i]);
  }
  return std::sqrt(v2);
}

// As many substeps as were asked for, more if the frame is long or a particle would travel too far in one.
Plan plan_frame(const State& s, double dt_s) {
  Plan plan;
  if (!(dt_s > 0.0)) return plan;
  plan.simulated_s = std::min(dt_s, kMaxSubsteps * kMaxSubstep_s);
  if (plan.simulated_s < dt_s) plan.limits |= kTimeCut;
  const double travel = plan.simulated_s * (static_cast<double>(fastest(s.particles)) +
                                            plan.simulated_s * s.options.environment.gravity_m_s2.norm());
  double wanted = s.options.substeps;
  wanted = std::max(wanted, std::ceil(plan.simulated_s / kMaxSubstep_s - 1e-9));
  wanted = std::max(wanted, std::ceil(travel / static_cast<double>(s.max_travel_m)));
  plan.substeps = static_cast<int>(std::min(wanted, static_cast<double>(kMaxSubsteps)));
  if (plan.substeps > s.options.substeps) plan.limits |= kMoreSubsteps;
  plan.substep_s = static_cast<float>(plan.simulated_s / plan.substeps);
  return plan;
}

// Slows particle i to the travel allowed; puts it to rest if its velocity is not finite.
std::uint32_t bound_velocity(Particles& p, std::size_t i, float top_speed) {
  const float v2 = p.vx[i] * p.vx[i] + p.vy[i] * p.vy[i] + p.vz[i] * p.vz[i];
  if (v2 <= top_speed * top_speed) return 0;
  const float scale = std::isfinite(v2) ? top_speed / std::sqrt(v2) : 0.0f;
  p.vx[i] = scale > 0.0f ? p.vx[i] * scale : 0.0f;
  p.vy[i] = scale > 0.0f ? p.vy[i] * scale : 0.0f;
  p.vz[i] = scale > 0.0f ? p.vz[i] * scale : 0.0f;
  return kSpeedClamped;
}

std::uint32_t predict(const engine::Context& context, float h, State& s) {
  Particles& p = s.particles;
  const float keep = std::exp(-static_cast<float>(s.fabric.damping_per_s) * h);
  const float top_speed = s.max_travel_m / h;
  std::atomic<std::uint32_t> limits{0};
  engine::parallel_for(context, p.count(), kParticleGrain, [&](std::size_t begin, std::size_t end) {
    accelerate(s.options.environment, s.air, h, begin, end, p);
    std::uint32_t mine = 0;
    for (std::size_t i = begin; i < end; ++i) {
      p.vx[i] *= keep, p.vy[i] *= keep, p.vz[i] *= keep;
      mine |= bound_velocity(p, i, top_speed);
      p.old_x[i] = p.x[i], p.old_y[i] = p.y[i], p.old_z[i] = p.z[i];
      p.x[i] += h * p.vx[i], p.y[i] += h * p.vy[i], p.z[i] += h * p.vz[i];
    }
    limits.fetch_or(mine, std::memory_order_relaxed);
  });
  return limits.load();
}

// A particle whose position is not finite goes back to where the substep began.
std::uint32_t reset_lost(Particles& p) {
  std::uint32_t limits = 0;
  for (std::size_t i = 0; i < p.count(); ++i) {
    if (std::isfinite(p.x[i] + p.y[i] + p.z[i])) continue;
    p.x[i] = p.old_x[i], p.y[i] = p.old_y[i], p.z[i] = p.old_z[i];
    limits |= kParticlesReset;
  }
  return limits;
}

void begin_frame(const engine::Context& context, State& s) {
  update_air(context, s.options.environment, s.options.seed, s.time_s, s.particles, s.air);
  Particles& p = s.particles;
  for (std::size_t i = 0; i < p.count(); ++i) {
    p.weight[i] = p.inverse_mass[i] * (s.contacts.touching[i] ? 1.0f / kTouchingMass : 1.0f);
  }
  update_weights(p, s.coarse);
}

}  // namespace

FrameReport advance(const engine::Context& context, const collision::Collider* collider, double dt_s,
                    State& s) {
  if (collider != nullptr) rebase(s.particles, collider->origin());
  const Plan plan = plan_frame(s, dt_s);
  FrameReport report;
  report.substeps = plan.substeps;
  report.simulated_s = plan.simulated_s;
  report.limits = plan.limits;
  if (plan.substeps > 0) begin_frame(context, s);
  for (int substep = 0; substep < plan.substeps; ++substep) {
    report.limits |= predict(context, plan.substep_s, s);
    move_pins(s.pins, (substep + 1.0) / plan.substeps, s.particles);
    solve_coarse(context, s.coarse, s.particles);
    for (int iteration = 0; iteration < s.options.iterations; ++iteration) {
      solve_bend(context, s.bend, plan.substep_s, s.particles);
      solve_stretch(context, s.stretch, plan.substep_s, s.particles);
    }
    report.limits |= reset_lost(s.particles);
    report.contacts.add(finish_substep(context, collider, s.options, static_cast<float>(s.fabric.friction),
                                       plan.substep_s, s.contacts, s.particles));
  }
  if (plan.substeps > 0) settle_pins(s.pins);
  s.time_s += plan.simulated_s;
  measure(context, s, report);
  return report;
}

}  // namespace bodice::cloth
