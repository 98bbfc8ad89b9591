#include "predict.hpp"

#include <algorithm>
#include <cmath>

namespace bodice::cloth {
namespace {

// Slows particle i to the travel allowed; puts it to rest if its velocity is not finite.
std::uint32_t bound_velocity(Particles& p, std::size_t i, float top_speed) {
  const float v2 = p.vx[i] * p.vx[i] + p.vy[i] * p.vy[i] + p.vz[i] * p.vz[i];
  if (v2 <= top_speed * top_speed || p.inverse_mass[i] == 0.0f) return 0;
  const float scale = std::isfinite(v2) ? top_speed / std::sqrt(v2) : 0.0f;
  p.vx[i] = scale > 0.0f ? p.vx[i] * scale : 0.0f;
  p.vy[i] = scale > 0.0f ? p.vy[i] * scale : 0.0f;
  p.vz[i] = scale > 0.0f ? p.vz[i] * scale : 0.0f;
  return kSpeedClamped;
}

struct Velocity {
  Float4 x, y, z;
};

// Those that nothing but the host or the end of sleep moves get their velocity back. Points from `end` on are
// other tasks' or idle ones.
void keep_held(const Velocity& before, std::size_t i, std::size_t end, Float4 damping, Particles& p) {
  Float4 weight = splat(0.0f);
  for (std::size_t k = i; k < end; ++k) weight[k - i] = p.point[k].weight;
  const auto free = weight > splat(0.0f);
  store(&p.vx[i], free ? damping * load(&p.vx[i]) : before.x);
  store(&p.vy[i], free ? damping * load(&p.vy[i]) : before.y);
  store(&p.vz[i], free ? damping * load(&p.vz[i]) : before.z);
}

bool any_faster(const Particles& p, std::size_t i, float top_speed) {
  const Float4 x = load(&p.vx[i]), y = load(&p.vy[i]), z = load(&p.vz[i]);
  const Float4 v2 = x * x + y * y + z * z;
  const float limit = top_speed * top_speed;  // written so that NaN is faster, too
  return !(v2[0] <= limit && v2[1] <= limit && v2[2] <= limit && v2[3] <= limit);
}

}  // namespace

std::uint32_t predict(const Environment& environment, const Air& air, const Prediction& how,
                      std::size_t begin, std::size_t end, Particles& p) {
  const Float4 damping = splat(std::exp(-how.damping_per_s * how.substep_s));
  std::uint32_t limits = 0;
  for (std::size_t i = begin; i < end; i += 4) {
    const Velocity before = {load(&p.vx[i]), load(&p.vy[i]), load(&p.vz[i])};
    accelerate(environment, air, how.substep_s, i, i + 4, p);
    const std::size_t last = std::min(i + 4, end);
    keep_held(before, i, last, damping, p);
    if (any_faster(p, i, how.top_speed_m_s))
      for (std::size_t k = i; k < last; ++k) limits |= bound_velocity(p, k, how.top_speed_m_s);
    Float4 x = load(&p.old_x[i]) + how.substep_s * load(&p.vx[i]);
    Float4 y = load(&p.old_y[i]) + how.substep_s * load(&p.vy[i]);
    Float4 z = load(&p.old_z[i]) + how.substep_s * load(&p.vz[i]);
    for (std::size_t k = i; k < last; ++k)
      p.point[k].x = x[k - i], p.point[k].y = y[k - i], p.point[k].z = z[k - i];
  }
  return limits;
}

}  // namespace bodice::cloth
