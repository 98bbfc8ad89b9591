#include "sleep.hpp"

#include <algorithm>
#include <cmath>

namespace bodice::cloth {
namespace {

constexpr float kSlow_m_s = 0.010f;    // slower than this is resting: a sixth of a millimetre a frame
constexpr float kWaking_m_s = 0.050f;  // a neighbour faster than this wakes
constexpr float kQuiet_s = 0.5f;       // longer than the turning point of any swing that one can see

}  // namespace

Sleep make_sleep(std::size_t particles) {
  Sleep s;
  for (auto* a : {&s.start_x, &s.start_y, &s.start_z, &s.speed, &s.quiet_s}) a->assign(particles, 0.0f);
  return s;
}

bool sleeps(const Sleep& sleep, std::size_t particle) {
  return sleep.quiet_s[particle] >= kQuiet_s;
}

void begin_sleep_frame(const Particles& p, Sleep& sleep) {
  std::copy(p.x.begin(), p.x.end(), sleep.start_x.begin());
  std::copy(p.y.begin(), p.y.end(), sleep.start_y.begin());
  std::copy(p.z.begin(), p.z.end(), sleep.start_z.begin());
}

void end_sleep_frame(const StretchConstraints& edges, double frame_s, Particles& p, Sleep& sleep) {
  const auto per_s = static_cast<float>(1.0 / frame_s);
  for (std::size_t i = 0; i < p.count(); ++i) {
    const float dx = p.x[i] - sleep.start_x[i], dy = p.y[i] - sleep.start_y[i],
                dz = p.z[i] - sleep.start_z[i];
    sleep.speed[i] = std::sqrt(dx * dx + dy * dy + dz * dz) * per_s;
    const bool slow = sleep.speed[i] < kSlow_m_s;
    sleep.quiet_s[i] = slow ? std::min(kQuiet_s, sleep.quiet_s[i] + static_cast<float>(frame_s)) : 0.0f;
  }
  for (std::size_t e = 0; e < edges.count(); ++e) {
    const Index a = edges.a[e], b = edges.b[e];
    if (std::max(sleep.speed[a], sleep.speed[b]) > kWaking_m_s) sleep.quiet_s[a] = sleep.quiet_s[b] = 0.0f;
  }
  sleep.asleep = 0;
  for (std::size_t i = 0; i < p.count(); ++i) {
    if (!sleeps(sleep, i)) continue;
    ++sleep.asleep;
    p.vx[i] = p.vy[i] = p.vz[i] = 0.0f;
  }
}

void wake_all(Sleep& sleep) {
  std::fill(sleep.quiet_s.begin(), sleep.quiet_s.end(), 0.0f);
}

}  // namespace bodice::cloth
