#include "collider/block_io.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "model/tolerances.hpp"

namespace bodice::inline v0_1::collision {

namespace {

void copy_lanes(const float* from, const Chosen& chosen, float* to) {
  if (!chosen.index) {
    std::memcpy(to, from + chosen.begin, static_cast<std::size_t>(chosen.count) * sizeof(float));
    return;
  }
  for (int lane = 0; lane < chosen.count; ++lane) to[lane] = from[chosen.index[lane]];
}

/// Copies positions, velocities and safe positions as the caller has them.
void copy_blocks(const ParticleView& particles, const Chosen& chosen, ParticleBatch& block) {
  if (!particles.packed) {
    const StridedParticles& of = particles.strided;
    gather_vectors(particles, of.position, of.origin, chosen, {block.x, block.y, block.z});
    if (block.has_velocity)
      gather_vectors(particles, of.velocity, kNoShift, chosen, {block.vx, block.vy, block.vz});
    if (block.has_safe) gather_vectors(particles, of.safe, of.origin, chosen, {block.sx, block.sy, block.sz});
    return;
  }
  const Particles& from = particles.arrays;
  copy_lanes(from.x, chosen, block.x);
  copy_lanes(from.y, chosen, block.y);
  copy_lanes(from.z, chosen, block.z);
  if (block.has_velocity) {
    copy_lanes(from.vx, chosen, block.vx);
    copy_lanes(from.vy, chosen, block.vy);
    copy_lanes(from.vz, chosen, block.vz);
  }
  if (block.has_safe) {
    copy_lanes(from.safe_x, chosen, block.sx);
    copy_lanes(from.safe_y, chosen, block.sy);
    copy_lanes(from.safe_z, chosen, block.sz);
  }
}

/// Writes vectors of a response where the caller has them.
template <class Scalar>
void scatter_positions(const GatheredBatch& gathered, const BatchResponse& response,
                       const ParticleView& particles) {
  const ParticleBatch& before = gathered.batch;
  for (int k = 0; k < response.count; ++k) {
    const std::int32_t lane = response.lane[k];
    write_vector<Scalar>(particles.strided.position, particles.element(gathered.index[lane]),
                         {response.x[k], response.y[k], response.z[k]},
                         {before.x[lane], before.y[lane], before.z[lane]}, particles.strided.origin);
  }
}

template <class Scalar>
void scatter_velocities(const GatheredBatch& gathered, const BatchResponse& response,
                        const ParticleView& particles) {
  const ParticleBatch& before = gathered.batch;
  for (int k = 0; k < response.count; ++k) {
    const std::int32_t lane = response.lane[k];
    write_vector<Scalar>(particles.strided.velocity, particles.element(gathered.index[lane]),
                         {response.vx[k], response.vy[k], response.vz[k]},
                         {before.vx[lane], before.vy[lane], before.vz[lane]}, kNoShift);
  }
}

void scatter_strided(const GatheredBatch& gathered, const BatchResponse& response,
                     const ParticleView& particles) {
  if (particles.strided.position.is_double)
    scatter_positions<double>(gathered, response, particles);
  else
    scatter_positions<float>(gathered, response, particles);
  if (!gathered.batch.has_velocity) return;
  if (particles.strided.velocity.is_double)
    scatter_velocities<double>(gathered, response, particles);
  else
    scatter_velocities<float>(gathered, response, particles);
}

/// Whether all values are finite and within kFarthest_m; written without a branch, so that it compiles to
/// vector code.
bool all_near(const float* values, int count) {
  int outside = 0;
  for (int lane = 0; lane < count; ++lane) outside += !(std::abs(values[lane]) < kFarthest_m);
  return outside == 0;
}

bool usable_lane(const ParticleBatch& block, int lane) {
  bool usable = true;
  for (const float* values : {block.x, block.y, block.z}) usable &= std::abs(values[lane]) < kFarthest_m;
  for (const float* values : {block.vx, block.vy, block.vz})
    if (block.has_velocity) usable &= std::isfinite(values[lane]);
  return usable;
}

bool finite_lane(const ParticleBatch& block, int lane) {
  bool finite = true;
  for (const float* values : {block.x, block.y, block.z}) finite &= std::isfinite(values[lane]);
  for (const float* values : {block.vx, block.vy, block.vz})
    if (block.has_velocity) finite &= std::isfinite(values[lane]);
  return finite;
}

void move_lane(int from, int to, GatheredBatch& g) {
  ParticleBatch& b = g.batch;
  for (float* values : {b.x, b.y, b.z, b.vx, b.vy, b.vz, b.sx, b.sy, b.sz}) values[to] = values[from];
  g.index[to] = g.index[from];
}

/// Removes the lanes that floats cannot represent well enough; the others close up.
void drop_unusable(GatheredBatch& g) {
  int kept = 0;
  for (int lane = 0; lane < g.batch.count; ++lane) {
    if (usable_lane(g.batch, lane))
      move_lane(lane, kept++, g);
    else if (finite_lane(g.batch, lane))
      g.far[g.far_count++] = g.index[lane];
    else
      ++g.not_finite;
  }
  g.batch.count = kept;
}

/// Replaces a safe position that is not usable by the particle's own position, which has no effect.
void mend_safe(ParticleBatch& block) {
  for (int lane = 0; lane < block.count; ++lane) {
    bool usable = true;
    for (const float* values : {block.sx, block.sy, block.sz}) usable &= std::abs(values[lane]) < kFarthest_m;
    if (usable) continue;
    block.sx[lane] = block.x[lane];
    block.sy[lane] = block.y[lane];
    block.sz[lane] = block.z[lane];
  }
}

/// Repeats the last lane until the block is full, so that no lane is read uninitialized.
void pad(ParticleBatch& block) {
  const int last = block.count - 1;
  const int end = (block.count + kBlock - 1) / kBlock * kBlock;
  for (int lane = block.count; lane < end; ++lane) {
    for (float* values : {block.x, block.y, block.z}) values[lane] = values[last];
    for (float* values : {block.vx, block.vy, block.vz})
      if (block.has_velocity) values[lane] = values[last];
    for (float* values : {block.sx, block.sy, block.sz})
      if (block.has_safe) values[lane] = values[last];
  }
}

}  // namespace

void gather(const ParticleView& particles, const std::uint32_t* index, std::size_t begin, std::size_t end,
            GatheredBatch& out) {
  ParticleBatch& block = out.batch;
  const int count = block.count = static_cast<int>(end - begin);
  block.has_velocity = particles.has_velocity();
  block.has_safe = particles.has_safe();
  out.far_count = 0;
  out.not_finite = 0;
  for (int lane = 0; lane < count; ++lane)
    out.index[lane] =
        index ? index[lane] : static_cast<std::uint32_t>(begin) + static_cast<std::uint32_t>(lane);
  copy_blocks(particles, {index, begin, count}, block);
  bool near = all_near(block.x, count) && all_near(block.y, count) && all_near(block.z, count);
  if (block.has_velocity)
    near = near && all_near(block.vx, count) && all_near(block.vy, count) && all_near(block.vz, count);
  if (block.has_safe &&
      (!all_near(block.sx, count) || !all_near(block.sy, count) || !all_near(block.sz, count)))
    mend_safe(block);
  if (!near) drop_unusable(out);
  if (block.count > 0) pad(block);
}

void scatter(const GatheredBatch& gathered, const BatchResponse& response, const ParticleView& view) {
  if (!view.packed) return scatter_strided(gathered, response, view);
  const Particles& particles = view.arrays;
  for (int k = 0; k < response.count; ++k) {
    const std::uint32_t i = gathered.index[response.lane[k]];
    particles.x[i] = response.x[k];
    particles.y[i] = response.y[k];
    particles.z[i] = response.z[k];
  }
  if (!gathered.batch.has_velocity) return;
  for (int k = 0; k < response.count; ++k) {
    const std::uint32_t i = gathered.index[response.lane[k]];
    particles.vx[i] = response.vx[k];
    particles.vy[i] = response.vy[k];
    particles.vz[i] = response.vz[k];
  }
}

}  // namespace bodice::collision
