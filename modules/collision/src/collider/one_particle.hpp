// One particle between the caller's memory and the exact side.
#pragma once

#include "exact/response.hpp"
#include "model/particle_view.hpp"

namespace bodice::inline v0_1::collision {

inline geometry::Vec3 vector_at(const float* x, const float* y, const float* z, std::size_t i) {
  return {double{x[i]}, double{y[i]}, double{z[i]}};
}

/// A vector of particle i as the kernels read it.
inline geometry::Vec3 vector_at(const ParticleView& particles, const StridedVectors& from,
                                const double (&shift)[3], std::size_t i) {
  float x, y, z;
  gather_vectors(particles, from, shift, {nullptr, i, 1}, {&x, &y, &z});
  return {double{x}, double{y}, double{z}};
}

inline ParticleState load(const ParticleView& particles, std::size_t i) {
  ParticleState state;
  const Particles& arrays = particles.arrays;
  const StridedParticles& of = particles.strided;
  const bool packed = particles.packed;
  state.position =
      packed ? vector_at(arrays.x, arrays.y, arrays.z, i) : vector_at(particles, of.position, of.origin, i);
  state.velocity = geometry::Vec3::Zero();
  state.safe = state.position;
  state.has_velocity = particles.has_velocity();
  if (state.has_velocity)
    state.velocity = packed ? vector_at(arrays.vx, arrays.vy, arrays.vz, i)
                            : vector_at(particles, of.velocity, kNoShift, i);
  if (particles.has_safe())
    state.safe = packed ? vector_at(arrays.safe_x, arrays.safe_y, arrays.safe_z, i)
                        : vector_at(particles, of.safe, of.origin, i);
  state.has_safe = particles.has_safe() && state.safe.allFinite();
  return state;
}

inline void write_one(const ParticleView& particles, const StridedVectors& to, const double (&shift)[3],
                      std::size_t i, const geometry::Vec3& now) {
  const geometry::Vec3 was = vector_at(particles, to, shift, i);
  const auto write_as = [&](auto scalar) {
    const auto number = [](const geometry::Vec3& of, int axis) { return static_cast<float>(of[axis]); };
    write_vector<decltype(scalar)>(to, particles.element(i), {number(now, 0), number(now, 1), number(now, 2)},
                                   {number(was, 0), number(was, 1), number(was, 2)}, shift);
  };
  if (to.is_double)
    write_as(double{});
  else
    write_as(float{});
}

inline void store(const ParticleState& state, const ParticleView& view, std::size_t i) {
  if (!view.packed) {
    write_one(view, view.strided.position, view.strided.origin, i, state.position);
    if (state.has_velocity) write_one(view, view.strided.velocity, kNoShift, i, state.velocity);
    return;
  }
  const Particles& particles = view.arrays;
  particles.x[i] = static_cast<float>(state.position.x());
  particles.y[i] = static_cast<float>(state.position.y());
  particles.z[i] = static_cast<float>(state.position.z());
  if (!state.has_velocity) return;
  particles.vx[i] = static_cast<float>(state.velocity.x());
  particles.vy[i] = static_cast<float>(state.velocity.y());
  particles.vz[i] = static_cast<float>(state.velocity.z());
}

}  // namespace bodice::collision
