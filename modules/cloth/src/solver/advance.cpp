// A frame: substeps of prediction, constraints and contact.
// Based on: Miles Macklin, Kier Storey, Michelle Lu, Pierre Terdiman, Nuttapong Chentanez, Stefan Jeschke,
// Matthias Mueller. Small Steps in Physics Simulation. 2019. - algorithm 1
// Differs: there are coarse levels. With several sweeps a substep, each sweep has its share of the compliance
// in place of a stored multiplier: soft constraints sum to the same force, and stiff ones are not affected.
#include <algorithm>
#include <atomic>
#include <cmath>

#include <bodice/engine/parallel.hpp>

#include "base/tolerances.hpp"
#include "motion/predict.hpp"
#include "solver/quality_controller.hpp"
#include "solver/state.hpp"

namespace bodice::inline v0_1::cloth {
namespace {

// One particle in this many may be faster than the substeps of a frame allow.
constexpr std::size_t kFewFast = 200;

// Up to this strain beyond the limit of the fabric a particle has all of its friction. At a strain that is
// larger by kFrictionFade it has none.
constexpr float kFullFrictionBeyond = 0.04f, kFrictionFade = 0.12f;
// Substeps are doubled while more than one particle in this many has reduced friction.
constexpr std::size_t kFewStretched = 1000;

// The speed that all but a few particles keep. The few that crushed cloth flings are slowed instead, because
// enough substeps for them would multiply the time of the frame.
double usual_speed(const engine::Context& context, State& s) {
  const Particles& p = s.particles;
  engine::parallel_for(context, p.count(), kParticleGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      s.scratch[i] = std::sqrt(p.vx[i] * p.vx[i] + p.vy[i] * p.vy[i] + p.vz[i] * p.vz[i]);
  });
  return static_cast<double>(nth_largest(context, s.scratch, p.count() / kFewFast, s.selection));
}

// Copies the particles [begin, end) to the points, with their weights for this frame; pinned and sleeping
// particles have a weight of 0. Returns whether a weight changed.
bool load_points(const Sleep& sleep, std::size_t begin, std::size_t end, Particles& p) {
  bool changed = false;
  for (std::size_t i = begin; i < end; ++i) {
    const float weight = sleeps(sleep, i) ? 0.0f : p.inverse_mass[i];
    changed = changed || weight != p.point[i].weight;
    p.point[i] = {p.x[i], p.y[i], p.z[i], weight};
  }
  return changed;
}

bool touches_itself(const Plan& plan, const State& s) {
  return s.options.self_collision && !(plan.limits & kNoSelfContact);
}

// The share of its friction that a particle has on a moving body, by the largest strain of its edges.
float friction_share_at(float strain, float full) {
  return strain > full ? std::max(0.0f, 1.0f - (strain - full) / kFrictionFade) : 1.0f;
}

// Reduces the friction of particles with edges that exceeded the limit of the fabric by far when the last
// frame ended. A body in a clip does not yield to tight cloth, and full friction would keep that cloth
// stretched.
void reduce_friction_where_stretched(State& s) {
  std::vector<float>& share = s.contacts.friction_share;
  const float full = static_cast<float>(s.fabric.max_stretch) + kFullFrictionBeyond;
  const bool stretched = s.longest_strain > full;
  if (!stretched && s.slipping == 0) return;
  std::ranges::fill(s.scratch, 0.0f);
  if (stretched) raise_to_strain(s.stretch, s.strain, full, s.scratch);
  for (std::size_t i = 0; i < share.size(); ++i) share[i] = friction_share_at(s.scratch[i], full);
  s.slipping = static_cast<std::size_t>(std::ranges::count_if(share, [](float one) { return one < 1.0f; }));
}

void begin_frame(const engine::Context& context, const Plan& plan, State& s) {
  Particles& p = s.particles;
  update_air(context, s.options.environment, s.options.seed, s.time_s, p, s.air);
  std::atomic<bool> changed{false};
  engine::parallel_for(context, p.count(), kParticleGrain, [&](std::size_t begin, std::size_t end) {
    if (load_points(s.sleep, begin, end, p)) changed.store(true, std::memory_order_relaxed);
    begin_sleep_frame(p, begin, end, s.sleep);
  });
  if (changed.load()) update_weights(context, p, s.coarse);
  begin_pin_paths(p, s.pins);
  if (touches_itself(plan, s))
    begin_self_contact(context, p, s.self);
  else
    s.self.crossings_known = false, forget_pairs(s.self);
}

void solve_block(std::size_t block, bool bend, float inverse_h2, Patch& patch, State& s) {
  if (bend) solve_bend_block(s.bend, block, inverse_h2, patch);
  solve_stretch_block(s.stretch, block, inverse_h2, patch);
}

// Predicts the particles, and makes one sweep over the constraints inside blocks. One worker does both for a
// block, while its patch of cloth is in the cache.
std::uint32_t predict_and_sweep(const engine::Context& context, const Plan& plan, bool bend, float inverse_h2,
                                State& s) {
  const Prediction how = {plan.substep_s, static_cast<float>(s.fabric.damping_per_s),
                          s.max_travel_m / plan.substep_s};
  std::atomic<std::uint32_t> limits{0};
  const std::size_t size = block_size(s.particles.count());
  engine::parallel_for(context, s.particles.count(), size, [&](std::size_t begin, std::size_t end) {
    Patch patch;
    limits.fetch_or(predict(s.options.environment, s.air, how, begin, s.particles, {patch.at, end - begin}),
                    std::memory_order_relaxed);
    solve_block(begin / size, bend, inverse_h2, patch, s);
    std::copy_n(patch.at, end - begin, &s.particles.point[begin]);
  });
  return limits.load();
}

void sweep(const engine::Context& context, bool bend, float inverse_h2, State& s) {
  const std::size_t size = block_size(s.particles.count());
  engine::parallel_for(context, s.particles.count(), size, [&](std::size_t begin, std::size_t end) {
    Patch patch;
    std::copy_n(&s.particles.point[begin], end - begin, patch.at);
    solve_block(begin / size, bend, inverse_h2, patch, s);
    std::copy_n(patch.at, end - begin, &s.particles.point[begin]);
  });
}

FrameShare share(int substep, const Plan& plan) {
  const auto all = static_cast<float>(plan.substeps);
  return {static_cast<float>(substep) / all, static_cast<float>(substep + 1) / all};
}

SelfSubstep self_substep(const Plan& plan, const State& s) {
  SelfSubstep substep{plan.substep_s, static_cast<float>(plan.simulated_s),
                      static_cast<float>(s.fabric.friction), !s.contacts.motion.moving, s.contacts.touching};
  if (s.contacts.motion.moving && s.slipping > 0) substep.friction_share = s.contacts.friction_share;
  return substep;
}

ResolvedBody resolved_body(const collision::Collider* collider, const FrameShare& share, const State& s) {
  const auto thickness_m = static_cast<float>(s.options.thickness_m);
  return {collider, &s.contacts.motion, thickness_m, thickness_m, 1.0f - share.end};
}

Support support_of(const ContactState& contacts) {
  Support support{contacts.touching, contacts.normal, {}, contacts.friction};
  if (contacts.motion.moving) support.friction_share = contacts.friction_share;
  return support;
}

std::uint32_t run_substep(const engine::Context& context, const collision::Collider* collider,
                          const Plan& plan, int substep, State& s) {
  Particles& p = s.particles;
  const auto substeps = static_cast<double>(plan.substeps);
  aim_pins(s.pins, substep / substeps, (substep + 1) / substeps, static_cast<double>(plan.substep_s), p);
  std::swap(p.x, p.old_x), std::swap(p.y, p.old_y), std::swap(p.z, p.old_z);
  const bool bend = !(plan.limits & kBendingHalved) || substep % 2 == 0;
  const float inverse_h2 = static_cast<float>(s.options.iterations) / (plan.substep_s * plan.substep_s);
  std::uint32_t limits = 0;
  for (int iteration = 0; iteration < s.options.iterations; ++iteration) {
    if (iteration == 0)
      limits |= predict_and_sweep(context, plan, bend, inverse_h2, s);
    else
      sweep(context, bend, inverse_h2, s);
    if (bend) solve_bend_across(context, s.bend, inverse_h2, p);
    solve_stretch_across(context, s.stretch, inverse_h2, p);
    solve_threads(s.threads, p.point);
  }
  solve_coarse(context, support_of(s.contacts), s.coarse, p);
  const SelfSubstep with_itself = self_substep(plan, s);
  free_yielding_pins(s.pins, true, p);
  if (touches_itself(plan, s)) push_apart(context, with_itself, s.self, p);
  limits |= resolve_body_contacts(context, collider, s.options, {plan.substep_s, share(substep, plan)},
                                  s.contacts, p);
  if (touches_itself(plan, s))
    hold_apart(context, with_itself, resolved_body(collider, share(substep, plan), s), s.self, p);
  free_yielding_pins(s.pins, false, p);
  return limits;
}

// Proves that triangles are out of the body, which may move particles once more, and stores the owners of all
// particles.
void end_contact(const engine::Context& context, const collision::Collider& collider, const Plan& plan,
                 State& s) {
  end_contact_frame(context, collider, s.options, s.contacts, s.particles);
  if (s.options.certify_m && touches_itself(plan, s))
    hold_apart(context, self_substep(plan, s), resolved_body(&collider, {}, s), s.self, s.particles);
  end_motion_frame(context, collider, s.particles, s.contacts.faces.nearest, s.contacts.motion);
}

void end_frame(const engine::Context& context, const Plan& plan, State& s) {
  const Environment& e = s.options.environment;
  Particles& p = s.particles;
  end_pin_paths(s.pins, p);
  end_sleep_frame(context, s.ring, plan.simulated_s, p, s.sleep);
  engine::parallel_for(context, p.count(), kParticleGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) p.point[i] = {p.x[i], p.y[i], p.z[i], p.point[i].weight};
  });
  if (e.gust > 0.0 && e.wind_m_s != Vec3::Zero()) wake_all(s.sleep);  // gusts never end
  s.time_s += plan.simulated_s;
}

// Begins a frame with this body; returns whether it moves. A body that moved or changed may no longer support
// a sleeping particle, so that all particles wake.
bool begin_collider(const collision::Collider* collider, State& s) {
  const Vec3 before = s.particles.origin;
  if (collider != nullptr) rebase(s.particles, collider->origin());
  const bool moved = collider != nullptr && is_moving(*collider);
  // The address does not identify the body: another proxy may have been assigned to the same object.
  const std::uint64_t proxy_hash = collider != nullptr ? collider->proxy_hash() : 0;
  // Velocities do not show every change: a pose that was set in no time has none.
  const std::uint64_t poses = collider != nullptr ? collider->poses() : 0;
  const bool same_body = collider == s.last_collider && proxy_hash == s.last_proxy_hash;
  if (moved || !same_body || poses != s.last_poses || before != s.particles.origin) wake_all(s.sleep);
  if (!same_body) forget_owners(s.contacts.motion);
  if (collider == nullptr) std::ranges::fill(s.contacts.touching, std::uint8_t{0});
  s.last_collider = collider;
  s.last_proxy_hash = proxy_hash;
  s.last_poses = poses;
  return moved;
}

}  // namespace

FrameReport advance(const engine::Context& context, const collision::Collider* collider, double dt_s,
                    State& s) {
  const std::int64_t start_ns = context.clock->now_ns();
  const bool moved = begin_collider(collider, s);
  if (moved) reduce_friction_where_stretched(s);
  const Pace pace{usual_speed(context, s), static_cast<double>(s.max_travel_m),
                  moved && s.slipping > s.particles.count() / kFewStretched};
  const Plan plan = plan_frame(s.options, dt_s, pace, s.budget.level);
  FrameReport report;
  report.substeps = plan.substeps;
  report.simulated_s = plan.simulated_s;
  report.limits = plan.limits;
  if (plan.substeps > 0) begin_frame(context, plan, s);
  begin_contact_frame(context,
                      {.body = plan.substeps > 0 ? collider : nullptr,
                       .moving = moved,
                       .length_s = dt_s,
                       .thickness_m = s.options.thickness_m,
                       .travel_m = plan.travel_m},
                      s.options, s.particles, s.contacts);
  for (int substep = 0; substep < plan.substeps; ++substep)
    report.limits |= run_substep(context, collider, plan, substep, s);
  if (plan.substeps > 0 && collider != nullptr) end_contact(context, *collider, plan, s);
  report_contacts(s.contacts, report);
  report.layers = report_self_contact(s.self);
  if (plan.substeps > 0) end_frame(context, plan, s);
  measure(context, s, report);
  report.frame_us = 1e-3 * static_cast<double>(context.clock->now_ns() - start_ns);
  adjust_quality(s.options, report.frame_us, s.budget);
  return report;
}

}  // namespace bodice::cloth
