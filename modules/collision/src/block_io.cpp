#include "block_io.hpp"

#include <algorithm>
#include <cmath>

#include "tolerances.hpp"

namespace bodice::collision {

namespace {

enum class Place { kNear, kFar, kNotFinite };

Place place_of(const Particles& p, std::uint32_t i) {
  const float largest = std::max({std::abs(p.x[i]), std::abs(p.y[i]), std::abs(p.z[i])});
  // Zero times NaN or Inf is NaN, and a NaN is not equal to itself.
  float sum = p.x[i] * 0.0f + p.y[i] * 0.0f + p.z[i] * 0.0f;
  if (p.vx) sum += p.vx[i] * 0.0f + p.vy[i] * 0.0f + p.vz[i] * 0.0f;
  if (!(sum == 0.0f)) return Place::kNotFinite;
  return largest < kFarthest ? Place::kNear : Place::kFar;
}

void load_lane(const Particles& p, std::uint32_t i, int lane, Block& block) {
  block.x[lane] = p.x[i];
  block.y[lane] = p.y[i];
  block.z[lane] = p.z[i];
  if (block.has_velocity) {
    block.vx[lane] = p.vx[i];
    block.vy[lane] = p.vy[i];
    block.vz[lane] = p.vz[i];
  }
  if (!block.has_safe) return;
  const bool usable = std::abs(p.safe_x[i]) < kFarthest && std::abs(p.safe_y[i]) < kFarthest &&
                      std::abs(p.safe_z[i]) < kFarthest;
  block.sx[lane] = usable ? p.safe_x[i] : p.x[i];
  block.sy[lane] = usable ? p.safe_y[i] : p.y[i];
  block.sz[lane] = usable ? p.safe_z[i] : p.z[i];
}

/// Repeats the last lane up to a whole vector of any width, so that no lane holds anything unset.
void pad(Block& block) {
  const int last = block.count - 1;
  const int end = std::min(kBlock, (block.count + 15) / 16 * 16);
  for (int lane = block.count; lane < end; ++lane) {
    for (float* values : {block.x, block.y, block.z}) values[lane] = values[last];
    for (float* values : {block.vx, block.vy, block.vz})
      if (block.has_velocity) values[lane] = values[last];
    for (float* values : {block.sx, block.sy, block.sz})
      if (block.has_safe) values[lane] = values[last];
  }
}

float half_diagonal(const Block& block) {
  float sum = 0.0f;
  for (const float* values : {block.x, block.y, block.z}) {
    float low = values[0], high = values[0];
    for (int lane = 1; lane < block.count; ++lane) {
      low = std::min(low, values[lane]);
      high = std::max(high, values[lane]);
    }
    sum += 0.25f * (high - low) * (high - low);
  }
  return std::sqrt(sum);
}

}  // namespace

void gather(const Particles& particles, std::span<const std::uint32_t> order, std::size_t begin,
            std::size_t end, Gathered& out) {
  Block& block = out.block;
  block.count = 0;
  block.has_velocity = particles.vx != nullptr;
  block.has_safe = particles.safe_x != nullptr;
  out.far_count = 0;
  out.not_finite = 0;
  for (std::size_t at = begin; at < end; ++at) {
    const std::uint32_t i = order.empty() ? static_cast<std::uint32_t>(at) : order[at];
    switch (place_of(particles, i)) {
      case Place::kNotFinite:
        ++out.not_finite;
        break;
      case Place::kFar:
        out.far[out.far_count++] = i;
        break;
      case Place::kNear:
        load_lane(particles, i, block.count, block);
        out.index[block.count++] = i;
        break;
    }
  }
  if (block.count == 0) return;
  pad(block);
  if (!order.empty()) out.radius_m = half_diagonal(block);
}

void scatter(const Gathered& gathered, int lane, const Particles& particles) {
  const Block& block = gathered.block;
  const std::uint32_t i = gathered.index[lane];
  particles.x[i] = block.x[lane];
  particles.y[i] = block.y[lane];
  particles.z[i] = block.z[lane];
  if (!block.has_velocity) return;
  particles.vx[i] = block.vx[lane];
  particles.vy[i] = block.vy[lane];
  particles.vz[i] = block.vz[lane];
}

}  // namespace bodice::collision
