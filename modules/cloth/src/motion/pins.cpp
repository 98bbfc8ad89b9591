#include "motion/pins.hpp"

#include <algorithm>

namespace bodice::inline v0_1::cloth {

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

void aim_pins(const Pins& pins, double time_s, Particles& p) {
  for (std::size_t i = 0; i < pins.particle.size(); ++i) {
    const Index particle = pins.particle[i];
    if (particle == geometry::kNoIndex) continue;
    const Vec3 velocity = (pins.to[i] - p.world(particle)) / time_s;
    p.vx[particle] = static_cast<float>(velocity[0]);
    p.vy[particle] = static_cast<float>(velocity[1]);
    p.vz[particle] = static_cast<float>(velocity[2]);
  }
}

void put_pins_on_targets(const Pins& pins, Particles& p) {
  for (std::size_t i = 0; i < pins.particle.size(); ++i) {
    const Index particle = pins.particle[i];
    if (particle == geometry::kNoIndex) continue;
    const Vec3 local = pins.to[i] - p.origin;
    p.x[particle] = static_cast<float>(local[0]);
    p.y[particle] = static_cast<float>(local[1]);
    p.z[particle] = static_cast<float>(local[2]);
  }
}

}  // namespace bodice::cloth
