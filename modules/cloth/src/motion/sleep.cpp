#include "motion/sleep.hpp"

#include <algorithm>
#include <cmath>

#include <bodice/engine/parallel.hpp>

#include "base/tolerances.hpp"

namespace bodice::inline v0_1::cloth {
namespace {

constexpr float kSlow_m_s = 0.010f;    // a slower particle rests: a sixth of a millimeter a frame
constexpr float kWaking_m_s = 0.050f;  // a faster neighbor wakes a particle
constexpr float kQuiet_s =
    0.5f;  // a particle sleeps after this time, longer than a visible swing takes to turn
// A particle that stays this close to its anchor only trembles. A drift at kSlow_m_s leaves this distance
// after kQuiet_s / 2.
constexpr float kTremble_m = 0.5f * kSlow_m_s * kQuiet_s;

// A particle that contact puts back by more than this share of the median edge in a substep does not sleep.
constexpr double kPullOfEdge = 0.25;

bool stays(const Particles& p, std::size_t i, const Point& anchor) {
  const float dx = p.x[i] - anchor.x, dy = p.y[i] - anchor.y, dz = p.z[i] - anchor.z;
  return dx * dx + dy * dy + dz * dz < kTremble_m * kTremble_m;
}

// Whether contact puts the particle back by a long distance in each substep. If it slept, it would no longer
// balance the neighbors that pull it, and they would move off.
bool is_pulled(const Particles& p, std::size_t i, float most_m) {
  const Point& pulled = p.point[i];
  const float dx = p.x[i] - pulled.x, dy = p.y[i] - pulled.y, dz = p.z[i] - pulled.z;
  return dx * dx + dy * dy + dz * dz > most_m * most_m;
}

// Finds the speeds of the particles [begin, end) over the frame.
void find_speeds(const Particles& p, std::size_t begin, std::size_t end, float per_s, Sleep& sleep) {
  for (std::size_t i = begin; i < end; ++i) {
    const float dx = p.x[i] - sleep.start_x[i], dy = p.y[i] - sleep.start_y[i],
                dz = p.z[i] - sleep.start_z[i];
    sleep.speed[i] = std::sqrt(dx * dx + dy * dy + dz * dz) * per_s;
    sleep.stays[i] = stays(p, i, sleep.anchor[i]);
  }
}

bool woken(const Ring& ring, std::size_t i, const Sleep& sleep) {
  return std::ranges::any_of(ring.of(i),
                             [&](Index j) { return sleep.speed[j] > kWaking_m_s && !sleep.stays[j]; });
}

}  // namespace

Sleep make_sleep(std::size_t particles, double median_edge_m) {
  Sleep s;
  s.pull_m = static_cast<float>(kPullOfEdge * median_edge_m);
  for (auto* a : {&s.start_x, &s.start_y, &s.start_z, &s.speed, &s.quiet_s}) a->assign(particles, 0.0f);
  s.anchor.assign(particles, Point{}), s.stays.assign(particles, 0);
  return s;
}

bool sleeps(const Sleep& sleep, std::size_t particle) {
  return sleep.quiet_s[particle] >= kQuiet_s;
}

void begin_sleep_frame(const Particles& p, std::size_t begin, std::size_t end, Sleep& sleep) {
  const auto first = static_cast<std::ptrdiff_t>(begin), last = static_cast<std::ptrdiff_t>(end);
  std::copy(p.x.begin() + first, p.x.begin() + last, sleep.start_x.begin() + first);
  std::copy(p.y.begin() + first, p.y.begin() + last, sleep.start_y.begin() + first);
  std::copy(p.z.begin() + first, p.z.begin() + last, sleep.start_z.begin() + first);
}

void end_sleep_frame(const engine::Context& context, const Ring& ring, double frame_s, Particles& p,
                     Sleep& sleep) {
  const auto per_s = static_cast<float>(1.0 / frame_s);
  engine::parallel_for(context, p.count(), kParticleGrain,
                       [&](std::size_t begin, std::size_t end) { find_speeds(p, begin, end, per_s, sleep); });
  engine::parallel_for(context, p.count(), kParticleGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const bool quiet = (sleep.speed[i] < kSlow_m_s || sleep.stays[i]) && !woken(ring, i, sleep) &&
                         !is_pulled(p, i, sleep.pull_m);
      sleep.quiet_s[i] = quiet ? std::min(kQuiet_s, sleep.quiet_s[i] + static_cast<float>(frame_s)) : 0.0f;
      if (!quiet || !sleep.stays[i]) sleep.anchor[i] = {p.x[i], p.y[i], p.z[i], 0.0f};
      if (sleeps(sleep, i)) p.vx[i] = p.vy[i] = p.vz[i] = 0.0f;
    }
  });
}

void wake_all(Sleep& sleep) {
  std::fill(sleep.quiet_s.begin(), sleep.quiet_s.end(), 0.0f);
}

}  // namespace bodice::cloth
