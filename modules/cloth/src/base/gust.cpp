// Based on: Geoffrey Taylor. The Spectrum of Turbulence. 1938. (the mean wind carries turbulence along)
#include "base/gust.hpp"

#include <algorithm>
#include <cmath>

#include <bodice/engine/random.hpp>

namespace bodice::inline v0_1::cloth {
namespace {

constexpr double kEddy_m = 0.6;  // a gust is about as wide as a garment

double smooth(double t) {
  return t * t * (3.0 - 2.0 * t);
}

// The number of a lattice node. A coordinate keeps 21 bits, so that the pattern repeats after 2 million
// eddies.
double node(const engine::Random& random, std::int64_t x, std::int64_t y, std::int64_t z) {
  constexpr std::int64_t kMask = (std::int64_t{1} << 21) - 1;
  const auto key = static_cast<std::uint64_t>((x & kMask) | ((y & kMask) << 21) | ((z & kMask) << 42));
  return 2.0 * random.uniform_at(key) - 1.0;
}

}  // namespace

double gust_factor(const Environment& environment, std::uint64_t seed, double time_s,
                   const geometry::Vec3& world_point) {
  const geometry::Vec3 q = (world_point - environment.wind_m_s * time_s) / kEddy_m;
  if (!(q.cwiseAbs().maxCoeff() < 0x1.0p60)) return 1.0;
  const engine::Random random(seed, 0x67757374);  // "gust"
  std::int64_t cell[3];
  double t[3];
  for (int axis = 0; axis < 3; ++axis) {
    const double floor = std::floor(q[axis]);
    cell[axis] = static_cast<std::int64_t>(floor);
    t[axis] = smooth(q[axis] - floor);
  }
  double sum = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const int dx = corner & 1, dy = (corner >> 1) & 1, dz = corner >> 2;
    const double weight = (dx ? t[0] : 1.0 - t[0]) * (dy ? t[1] : 1.0 - t[1]) * (dz ? t[2] : 1.0 - t[2]);
    sum += weight * node(random, cell[0] + dx, cell[1] + dy, cell[2] + dz);
  }
  return 1.0 + std::clamp(environment.gust, 0.0, 1.0) * sum;
}

}  // namespace bodice::cloth
