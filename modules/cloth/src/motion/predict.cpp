#include "motion/predict.hpp"

#include <algorithm>
#include <cmath>

namespace bodice::inline v0_1::cloth {
namespace {

// Slows particle i to the top speed, or stops it if its velocity is not finite.
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

// Damps the velocities of free particles, and restores those of pinned and sleeping ones.
void damp_free_particles(const Velocity& before, std::size_t i, Float4 weight, Float4 damping, Particles& p) {
  const auto free = weight > splat(0.0f);
  store(&p.vx[i], free ? damping * load(&p.vx[i]) : before.x);
  store(&p.vy[i], free ? damping * load(&p.vy[i]) : before.y);
  store(&p.vz[i], free ? damping * load(&p.vz[i]) : before.z);
}

bool any_faster(const Particles& p, std::size_t i, float top_speed) {
  const Float4 x = load(&p.vx[i]), y = load(&p.vy[i]), z = load(&p.vz[i]);
  const Float4 v2 = x * x + y * y + z * z;
  const float limit = top_speed * top_speed;  // the comparison below counts NaN as faster
  return !(v2[0] <= limit && v2[1] <= limit && v2[2] <= limit && v2[3] <= limit);
}

// Writes four points at (x, y, z), or fewer at the end, because idle slots use the points beyond it.
void write_points(Float4 x, Float4 y, Float4 z, Float4 weight, std::size_t count, Point* point) {
  Float4 at[4] = {x, y, z, weight};
  transpose(at[0], at[1], at[2], at[3]);
  for (std::size_t k = 0; k < count; ++k) store(point[k], at[k]);
}

}  // namespace

std::uint32_t predict(const Environment& environment, const Air& air, const Prediction& how,
                      std::size_t begin, Particles& p, std::span<Point> points) {
  const std::size_t end = begin + points.size();
  const Float4 damping = splat(std::exp(-how.damping_per_s * how.substep_s));
  std::uint32_t limits = 0;
  for (std::size_t i = begin; i < end; i += 4) {
    const Velocity before = {load(&p.vx[i]), load(&p.vy[i]), load(&p.vz[i])};
    accelerate(environment, air, how.substep_s, i, i + 4, p);
    const std::size_t last = std::min(i + 4, end);
    const Point* const point = &p.point[i];
    const Float4 weight = weights(load(point[0]), load(point[1]), load(point[2]), load(point[3]));
    damp_free_particles(before, i, weight, damping, p);
    if (any_faster(p, i, how.top_speed_m_s))
      for (std::size_t k = i; k < last; ++k) limits |= bound_velocity(p, k, how.top_speed_m_s);
    write_points(load(&p.old_x[i]) + how.substep_s * load(&p.vx[i]),
                 load(&p.old_y[i]) + how.substep_s * load(&p.vy[i]),
                 load(&p.old_z[i]) + how.substep_s * load(&p.vz[i]), weight, last - i,
                 points.data() + (i - begin));
  }
  return limits;
}

}  // namespace bodice::cloth
