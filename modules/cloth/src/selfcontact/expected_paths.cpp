#include "selfcontact/expected_paths.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

#include <bodice/engine/parallel.hpp>

#include "base/tolerances.hpp"

namespace bodice::inline v0_1::cloth {
namespace {

// The weight of a substep's velocity in the smoothed velocity. Sweeps leave particles trembling, which
// averages out.
constexpr float kSmoothing = 0.25f;
// The squared speed below which a smoothed velocity becomes zero, square meters a square second. At rest it
// halves every few substeps, and arithmetic with subnormal floats takes a hundred times as long.
constexpr float kNoDrift2 = 1e-20f;

// The part of the path of a particle on the body that is farther than `most_m` from where its smoothed
// velocity leads.
Float4 excess(const SelfSubstep& substep, float most_m, const Point& at, std::size_t i,
              const SelfContact& s) {
  if (!substep.touching[i]) return splat(0.0f);
  const Float4 off = xyz(load(at) - load(s.before[i]) - substep.length_s * load(s.paths.drift[i]));
  const float length_m = std::sqrt(dot(off, off));
  return length_m > most_m ? (1.0f - most_m / length_m) * off : splat(0.0f);
}

}  // namespace

Expectation::Expectation(float since_s, float most, const SelfContact& s)
    : self(s), share(std::min(1.0f, since_s / s.paths.duration_s)), most_m(most) {}

bool measure_deviations(const engine::Context& context, std::span<const Point> at, float since_s,
                        float most_m, SelfContact& s) {
  const Expectation expected(since_s, most_m, s);
  std::atomic<bool> far{false};
  engine::parallel_for(context, s.paths.start.size(), kParticleGrain,
                       [&](std::size_t begin, std::size_t end) {
                         bool any_far = false;
                         for (std::size_t i = begin; i < end; ++i) {
                           s.paths.deviation2[i] = expected.deviation2(at, i);
                           any_far = any_far || !expected.allows(s.paths.deviation2[i], i);
                         }
                         if (any_far) far.store(true, std::memory_order_relaxed);
                       });
  return far.load();
}

bool measure_deviations_of(std::span<const std::uint32_t> leaves, std::span<const Point> at, float since_s,
                           float most_m, SelfContact& s) {
  const Expectation expected(since_s, most_m, s);
  bool any_far = false;
  for (const std::uint32_t leaf : leaves)
    for (const Index i : s.mesh.particles_of(leaf)) {
      s.paths.deviation2[i] = expected.deviation2(at, i);
      any_far = any_far || !expected.allows(s.paths.deviation2[i], i);
    }
  return any_far;
}

float largest_deviation(std::size_t leaf, const SelfContact& s) {
  float deviation2 = 0.0f;
  for (const Index i : s.mesh.particles_of(leaf)) deviation2 = std::max(deviation2, s.paths.deviation2[i]);
  return std::sqrt(deviation2);
}

void expect_paths(const engine::Context& context, const SelfSubstep& substep, std::span<const Point> at,
                  float most_m, SelfContact& s) {
  s.paths.duration_s = std::max(substep.length_s, substep.frame_s), s.paths.since_s = 0.0f;
  const float share = substep.length_s / s.paths.duration_s;
  engine::parallel_for(
      context, s.paths.start.size(), kParticleGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          const Float4 path = xyz(load(at[i]) - load(s.before[i])),
                       expected = xyz(s.paths.duration_s * load(s.paths.drift[i])),
                       off = path - share * expected;
          s.paths.start[i] = s.before[i], s.paths.allowance_m[i] = 0.0f;
          const float kept = std::min(1.0f, most_m / std::sqrt(dot(off, off) + kTinyLength2));
          store(s.paths.move[i], expected + (1.0f - kept) / share * off);
        }
      });
}

void expect_contact_positions(const engine::Context& context, const SelfSubstep& substep, float most_m,
                              const Particles& p, SelfContact& s) {
  engine::parallel_for(context, p.count(), kParticleGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      store(s.now[i], load(p.point[i]) - excess(substep, most_m, p.point[i], i, s));
  });
}

void hold_back_pulled(const engine::Context& context, const SelfSubstep& substep, float most_m, Particles& p,
                      SelfContact& s) {
  if (substep.friction_share.empty()) return;
  engine::parallel_for(context, p.count(), kParticleGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const bool stretched = substep.friction_share[i] < 1.0f;
      const Float4 pulled = stretched ? excess(substep, most_m, p.point[i], i, s) : splat(0.0f);
      store(s.paths.pulled[i], pulled);
      store(p.point[i], load(p.point[i]) - pulled);
    }
  });
}

void release_pulled(const engine::Context& context, const SelfSubstep& substep, Particles& p,
                    SelfContact& s) {
  if (substep.friction_share.empty()) return;
  engine::parallel_for(context, p.count(), kParticleGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) store(p.point[i], load(p.point[i]) + load(s.paths.pulled[i]));
  });
}

void update_drift(const engine::Context& context, float substep_s, SelfContact& s) {
  engine::parallel_for(
      context, s.paths.drift.size(), kParticleGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          const Float4 drift = load(s.paths.drift[i]), now = (load(s.now[i]) - load(s.before[i])) / substep_s;
          const Float4 smoothed = drift + kSmoothing * (now - drift);
          store(s.paths.drift[i], dot(smoothed, smoothed) < kNoDrift2 ? splat(0.0f) : smoothed);
        }
      });
}

}  // namespace bodice::cloth
