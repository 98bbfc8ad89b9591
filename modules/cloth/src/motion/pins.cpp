#include "motion/pins.hpp"

#include <algorithm>

namespace bodice::inline v0_1::cloth {
namespace {

// The speed at which pins that contact moved return to their paths, and the distance beyond which they return
// at once. Without this limit, pins in crossing layers were dragged by 9 cm, and the cloth around them tore.
constexpr double kReturn_m_s = 0.5, kFarthestPin_m = 0.01;

// How far a pin that is `off_m` off its path returns in a substep.
double return_from(double off_m, double substep_s) {
  return std::max(std::min(off_m, kReturn_m_s * substep_s), off_m - kFarthestPin_m);
}

}  // namespace

bool set_pin_targets(std::span<const Vec3> world_positions, Pins& pins) {
  const std::size_t count = std::min(world_positions.size(), pins.to.size());
  bool moved = false;
  for (std::size_t i = 0; i < count; ++i) {
    if (!world_positions[i].allFinite() || world_positions[i] == pins.to[i]) continue;
    pins.to[i] = world_positions[i];
    moved = true;
  }
  return moved;
}

void begin_pin_paths(const Particles& p, Pins& pins) {
  if (pins.yield) return;
  for (std::size_t i = 0; i < pins.particle.size(); ++i)
    if (pins.particle[i] != geometry::kNoIndex) pins.from[i] = p.world(pins.particle[i]);
}

void aim_pins(const Pins& pins, double begin, double end, double substep_s, Particles& p) {
  for (std::size_t i = 0; i < pins.particle.size(); ++i) {
    const Index particle = pins.particle[i];
    if (particle == geometry::kNoIndex) continue;
    const Vec3 path = pins.to[i] - pins.from[i];
    Vec3 back = pins.from[i] + begin * path - p.world(particle);
    const double off_m = back.norm();
    if (pins.yield && off_m > 0.0) back *= return_from(off_m, substep_s) / off_m;
    const Vec3 velocity = ((end - begin) * path + back) / substep_s;
    p.vx[particle] = static_cast<float>(velocity[0]);
    p.vy[particle] = static_cast<float>(velocity[1]);
    p.vz[particle] = static_cast<float>(velocity[2]);
  }
}

void end_pin_paths(Pins& pins, Particles& p) {
  pins.from = pins.to;
  if (pins.yield) return;
  for (std::size_t i = 0; i < pins.particle.size(); ++i) {
    const Index particle = pins.particle[i];
    if (particle == geometry::kNoIndex) continue;
    const Vec3 local = pins.to[i] - p.origin;
    p.x[particle] = static_cast<float>(local[0]);
    p.y[particle] = static_cast<float>(local[1]);
    p.z[particle] = static_cast<float>(local[2]);
  }
}

void free_yielding_pins(const Pins& pins, bool free, Particles& p) {
  if (!pins.yield) return;
  for (const Index particle : pins.particle)
    if (particle != geometry::kNoIndex) p.point[particle].weight = free ? 1.0f / p.mass[particle] : 0.0f;
}

}  // namespace bodice::cloth
