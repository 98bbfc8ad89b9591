// The particles of a call, in any of the forms that a caller may have them in.
#pragma once

#include <bit>
#include <cstring>

#include <bodice/collision/collider.hpp>
#include <bodice/collision/strided_particles.hpp>

namespace bodice::inline v0_1::collision {

/// Particles of the caller: arrays of floats that kernels may read in place, or vectors that are gathered.
struct ParticleView {
  // This constructor is implicit, because packed arrays are the usual form.
  ParticleView(const Particles& arrays);
  explicit ParticleView(const StridedParticles& vectors);

  bool has_positions() const {
    return packed ? arrays.x && arrays.y && arrays.z : strided.position.present();
  }
  bool has_velocity() const { return packed ? arrays.vx != nullptr : strided.velocity.present(); }
  bool has_safe() const { return packed ? arrays.safe_x != nullptr : strided.safe.present(); }
  /// The index of a particle's vectors in the caller's arrays.
  std::size_t element(std::size_t i) const { return strided.element ? strided.element[i] : i; }

  std::size_t count = 0;
  bool packed = true;
  Particles arrays;          ///< if packed; optional arrays are complete or absent
  StridedParticles strided;  ///< otherwise
};

/// The shift of vectors that are no positions, such as velocities.
inline constexpr double kNoShift[3] = {0.0, 0.0, 0.0};

/// The number at an address as the kernels' float, less a shift.
inline float read_number(const std::byte* at, bool is_double, double shift) {
  double number;
  if (is_double) {
    std::memcpy(&number, at, sizeof number);
  } else {
    float narrow;
    std::memcpy(&narrow, at, sizeof narrow);
    number = double{narrow};
  }
  return static_cast<float>(number - shift);
}

/// A coordinate of each particle's position in the local frame, for work that is done now and then.
struct StridedAxis {
  const ParticleView& particles;
  const std::byte* first;
  double shift;

  float operator[](std::size_t i) const {
    const auto step = static_cast<std::ptrdiff_t>(particles.element(i)) * particles.strided.position.stride;
    return read_number(first + step, particles.strided.position.is_double, shift);
  }
};

/// Calls work(x, y, z) with what gives the coordinates of particle i as x[i], y[i], z[i].
template <class Work>
auto with_axes(const ParticleView& particles, Work&& work) {
  const float *const x = particles.arrays.x, *const y = particles.arrays.y, *const z = particles.arrays.z;
  if (particles.packed) return work(x, y, z);
  const StridedVectors& at = particles.strided.position;
  const double(&origin)[3] = particles.strided.origin;
  return work(StridedAxis{particles, at.x, origin[0]}, StridedAxis{particles, at.y, origin[1]},
              StridedAxis{particles, at.z, origin[2]});
}

/// The particles of one gather: those of `index`, or the `count` ones from `begin` on if it is null.
struct Chosen {
  const std::uint32_t* index;
  std::size_t begin;
  int count;
};

/// Reads vectors of the chosen particles, less `shift`.
void gather_vectors(const ParticleView& particles, const StridedVectors& from, const double (&shift)[3],
                    const Chosen& chosen, float* const (&to)[3]);

/// Writes a vector, plus `shift`, where it differs from what was read; other numbers keep their bits.
template <class Scalar>
void write_vector(const StridedVectors& to, std::size_t element, const float (&now)[3],
                  const float (&before)[3], const double (&shift)[3]) {
  std::byte* const first[3] = {to.x, to.y, to.z};
  const std::ptrdiff_t step = static_cast<std::ptrdiff_t>(element) * to.stride;
  for (int axis = 0; axis < 3; ++axis) {
    if (std::bit_cast<std::uint32_t>(now[axis]) == std::bit_cast<std::uint32_t>(before[axis])) continue;
    const auto number = static_cast<Scalar>(double{now[axis]} + shift[axis]);
    std::memcpy(first[axis] + step, &number, sizeof number);
  }
}

}  // namespace bodice::collision
