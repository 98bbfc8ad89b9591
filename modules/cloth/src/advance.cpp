// One frame: substeps of predict, solve, contact.
// Based on: Miles Macklin, Kier Storey, Michelle Lu, Pierre Terdiman, Nuttapong Chentanez, Stefan Jeschke,
// Matthias Mueller. Small Steps in Physics Simulation. 2019. - algorithm 1
// Differs: coarse levels first. With several sweeps a substep each gets its share of the compliance instead
// of a stored multiplier: soft constraints sum to the same force, stiff ones do not feel it.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>

#include <bodice/engine/parallel.hpp>

#include "pack.hpp"
#include "plan.hpp"
#include "state.hpp"

namespace bodice::cloth {
namespace {

double fastest(const Particles& p) {
  float v2 = 0.0f;
  for (std::size_t i = 0; i < p.count(); ++i) {
    v2 = std::max(v2, p.vx[i] * p.vx[i] + p.vy[i] * p.vy[i] + p.vz[i] * p.vz[i]);
  }
  return static_cast<double>(std::sqrt(v2));
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

void begin_frame(const engine::Context& context, const Plan& plan, State& s) {
  Particles& p = s.particles;
  update_air(context, s.options.environment, s.options.seed, s.time_s, p, s.air);
  for (std::size_t i = 0; i < p.count(); ++i) {
    p.weight[i] = sleeps(s.sleep, i) ? 0.0f : p.inverse_mass[i];
  }
  update_weights(p, s.coarse);
  begin_sleep_frame(p, s.sleep);
  if (s.options.self_collision && !(plan.limits & kNoSelfContact)) find_close_pairs(context, p, s.self);
}

void solve(const engine::Context& context, const Plan& plan, int substep, State& s) {
  solve_coarse(context, s.coarse, s.particles);
  const bool bend = !(plan.limits & kBendingHalved) || substep % 2 == 0;
  const float inverse_h2 = static_cast<float>(s.options.iterations) / (plan.substep_s * plan.substep_s);
  for (int iteration = 0; iteration < s.options.iterations; ++iteration) {
    if (bend) solve_bend(context, s.bend, inverse_h2, s.particles);
    solve_stretch(context, s.stretch, inverse_h2, s.particles);
  }
  if (s.options.self_collision && !(plan.limits & kNoSelfContact)) push_apart(context, s.contacts.touching, s.self, s.particles);
}

void end_frame(const Plan& plan, State& s) {
  settle_pins(s.pins);
  const Environment& e = s.options.environment;
  end_sleep_frame(s.stretch, plan.simulated_s, s.particles, s.sleep);
  s.self.travel_m +=
      plan.simulated_s * static_cast<double>(*std::max_element(s.sleep.speed.begin(), s.sleep.speed.end()));
  if (e.gust > 0.0 && e.wind_m_s != Vec3::Zero()) wake_all(s.sleep);  // the air never rests
  s.time_s += plan.simulated_s;
}

// A body that moved or changed may have taken a sleeper's support away.
void meet_collider(const collision::Collider* collider, State& s) {
  const Vec3 before = s.particles.origin;
  if (collider != nullptr) rebase(s.particles, collider->origin());
  if (collider != s.last_collider || before != s.particles.origin) wake_all(s.sleep);
  s.last_collider = collider;
}

}  // namespace

FrameReport advance(const engine::Context& context, const collision::Collider* collider, double dt_s,
                    State& s) {
  const auto start = std::chrono::steady_clock::now();
  meet_collider(collider, s);
  const Plan plan =
      plan_frame(s.options, dt_s, fastest(s.particles), static_cast<double>(s.max_travel_m), s.budget.level);
  FrameReport report;
  report.substeps = plan.substeps;
  report.simulated_s = plan.simulated_s;
  report.limits = plan.limits;
  if (plan.substeps > 0) begin_frame(context, plan, s);
  for (int substep = 0; substep < plan.substeps; ++substep) {
    report.limits |= predict(context, plan.substep_s, s);
    move_pins(s.pins, (substep + 1.0) / plan.substeps, s.particles);
    solve(context, plan, substep, s);
    report.limits |= reset_lost(s.particles);
    report.contacts.add(finish_substep(context, collider, s.options, static_cast<float>(s.fabric.friction),
                                       plan.substep_s, s.contacts, s.particles));
  }
  if (plan.substeps > 0) end_frame(plan, s);
  measure(context, s, report);
  learn(s.options,
        std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count(),
        s.budget);
  return report;
}

}  // namespace bodice::cloth
