#include "model/particle_view.hpp"

#include "model/batch.hpp"

namespace bodice::inline v0_1::collision {

namespace {

/// The arrays with each of the optional ones complete or absent.
Particles completed(Particles particles) {
  if (!particles.vx || !particles.vy || !particles.vz) particles.vx = particles.vy = particles.vz = nullptr;
  if (!particles.safe_x || !particles.safe_y || !particles.safe_z)
    particles.safe_x = particles.safe_y = particles.safe_z = nullptr;
  return particles;
}

/// Whether vectors are absent, or three arrays of floats that kernels may read.
bool are_arrays(const StridedVectors& vectors) {
  const auto aligned = [](const std::byte* at) {
    return reinterpret_cast<std::uintptr_t>(at) % alignof(float) == 0;
  };
  return !vectors.present() || (!vectors.is_double && vectors.stride == sizeof(float) && aligned(vectors.x) &&
                                aligned(vectors.y) && aligned(vectors.z));
}

float* floats(std::byte* at) {
  return reinterpret_cast<float*>(at);
}

/// Reads vectors of three numbers in a row, `kStride` numbers apart, in vector code.
template <class Scalar, std::ptrdiff_t kStride>
void read_structures(const std::byte* from, const double (&shift)[3], int count, float* const (&to)[3]) {
  float *const x = to[0], *const y = to[1], *const z = to[2];
  const double shift_x = shift[0], shift_y = shift[1], shift_z = shift[2];
  for (std::ptrdiff_t lane = 0; lane < count; ++lane) {
    Scalar number[3];
    std::memcpy(number, from + lane * kStride * static_cast<std::ptrdiff_t>(sizeof(Scalar)), sizeof number);
    x[lane] = static_cast<float>(static_cast<double>(number[0]) - shift_x);
    y[lane] = static_cast<float>(static_cast<double>(number[1]) - shift_y);
    z[lane] = static_cast<float>(static_cast<double>(number[2]) - shift_z);
  }
}

/// Reads one number of each vector: number `at(lane)`.
template <class Scalar, class At>
void read_numbers(const std::byte* from, double shift, int count, float* to, At&& at) {
  for (int lane = 0; lane < count; ++lane) {
    Scalar number;
    std::memcpy(&number, from + at(lane), sizeof number);
    to[lane] = static_cast<float>(static_cast<double>(number) - shift);
  }
}

template <class Scalar>
void gather_as(const ParticleView& particles, const StridedVectors& from, const double (&shift)[3],
               const Chosen& chosen, float* const (&to)[3]) {
  const std::byte* const first[3] = {from.x, from.y, from.z};
  const int count = chosen.count;
  if (!chosen.index && !particles.strided.element) {
    const std::ptrdiff_t begin = static_cast<std::ptrdiff_t>(chosen.begin) * from.stride;
    constexpr std::ptrdiff_t kSize = sizeof(Scalar);
    const bool together = from.y - from.x == kSize && from.z - from.x == 2 * kSize;
    if (together && from.stride == 3 * kSize)
      return read_structures<Scalar, 3>(from.x + begin, shift, count, to);
    if (together && from.stride == 4 * kSize)
      return read_structures<Scalar, 4>(from.x + begin, shift, count, to);
    for (int axis = 0; axis < 3; ++axis)
      read_numbers<Scalar>(first[axis] + begin, shift[axis], count, to[axis],
                           [&](int lane) { return lane * from.stride; });
    return;
  }
  std::ptrdiff_t step[kBatch];
  for (int lane = 0; lane < count; ++lane) {
    const std::size_t i = chosen.index ? chosen.index[lane] : chosen.begin + static_cast<std::size_t>(lane);
    step[lane] = static_cast<std::ptrdiff_t>(particles.element(i)) * from.stride;
  }
  for (int axis = 0; axis < 3; ++axis)
    read_numbers<Scalar>(first[axis], shift[axis], count, to[axis], [&](int lane) { return step[lane]; });
}

}  // namespace

ParticleView::ParticleView(const Particles& given) : count(given.count), arrays(completed(given)) {}

ParticleView::ParticleView(const StridedParticles& given) : count(given.count), strided(given) {
  packed = !given.element && given.origin[0] == 0.0 && given.origin[1] == 0.0 && given.origin[2] == 0.0 &&
           are_arrays(given.position) && are_arrays(given.velocity) && are_arrays(given.safe);
  if (!packed) return;
  arrays = completed({.count = given.count,
                      .x = floats(given.position.x),
                      .y = floats(given.position.y),
                      .z = floats(given.position.z),
                      .vx = floats(given.velocity.x),
                      .vy = floats(given.velocity.y),
                      .vz = floats(given.velocity.z),
                      .safe_x = floats(given.safe.x),
                      .safe_y = floats(given.safe.y),
                      .safe_z = floats(given.safe.z)});
}

void gather_vectors(const ParticleView& particles, const StridedVectors& from, const double (&shift)[3],
                    const Chosen& chosen, float* const (&to)[3]) {
  if (from.is_double)
    gather_as<double>(particles, from, shift, chosen, to);
  else
    gather_as<float>(particles, from, shift, chosen, to);
}

}  // namespace bodice::collision
