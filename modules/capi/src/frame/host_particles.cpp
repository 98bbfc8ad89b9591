#include "frame/host_particles.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <type_traits>

#include <bodice/engine/parallel.hpp>

#include "base/handles.hpp"
#include "base/structures.hpp"

namespace bodice::capi {
namespace {

constexpr std::size_t kParticlesATask = 4096;  ///< particles that one task copies: some ten microseconds
constexpr std::size_t kLine = 16;              ///< floats of a cache line, which are compared at once

/// Calls work(component of a vector as Scalar, axis) with the type that the host has.
template <class Work>
void with_scalar(bool is_double, Work&& work) {
  if (is_double)
    work(double{});
  else
    work(float{});
}

/// The engine's float of a number of the host.
template <class Scalar>
float inward(Scalar value, double origin) {
  return static_cast<float>(static_cast<double>(value) - origin);
}

/// a or b, without a branch: which particles a response moves is as good as random.
template <class Scalar>
Scalar chosen(bool first, Scalar a, Scalar b) {
  using Bits = std::conditional_t<sizeof(Scalar) == 8, std::uint64_t, std::uint32_t>;
  const Bits mask = Bits{0} - Bits{first};
  return std::bit_cast<Scalar>((std::bit_cast<Bits>(a) & mask) | (std::bit_cast<Bits>(b) & ~mask));
}

/// What a response may have changed: arrays of `count` floats, `length` apart, as they were before.
struct Changed {
  const std::uint32_t* index;  ///< the element of each; null: in order
  std::size_t count;
  const float* before;
  std::size_t length;
};

/// Writes the values of `after` that differ from those before. All is passed by value, so that the compiler
/// knows it unchanged by the host's bytes.
template <class Scalar>
void write_changed(const Changed changed, const float* const (&after)[3], const double (&shift)[3],
                   const StridedVectors to) {
  const float *const x = after[0], *const y = after[1], *const z = after[2];
  const float *const old_x = changed.before, *const old_y = old_x + changed.length,
                     *const old_z = old_y + changed.length;
  const double shift_x = shift[0], shift_y = shift[1], shift_z = shift[2];
  const auto differs = [](float a, float b) {
    return std::bit_cast<std::uint32_t>(a) ^ std::bit_cast<std::uint32_t>(b);
  };
  for (std::size_t begin = 0; begin < changed.count; begin += kLine) {
    const std::size_t end = std::min(changed.count, begin + kLine);
    std::uint32_t any = 0;
    for (std::size_t i = begin; i < end; ++i)
      any |= differs(x[i], old_x[i]) | differs(y[i], old_y[i]) | differs(z[i], old_z[i]);
    if (any == 0) continue;
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t e = changed.index ? changed.index[i] : i;
      const auto write = [&](const Strided& numbers, float value, float old, double by) {
        numbers.set(e, chosen(differs(value, old) != 0, static_cast<Scalar>(static_cast<double>(value) + by),
                              numbers.get<Scalar>(e)));
      };
      write(to.x, x[i], old_x[i], shift_x);
      write(to.y, y[i], old_y[i], shift_y);
      write(to.z, z[i], old_z[i], shift_z);
    }
  }
}

}  // namespace

bool HostParticles::is_pinned(std::size_t i) const {
  if (mask && mask.get<std::uint8_t>(i) == 0) return true;
  if (!inverse_mass) return false;
  return !((mass_is_double ? inverse_mass.get<double>(i) : double{inverse_mass.get<float>(i)}) > 0.0);
}

bool HostParticles::fits_engine() const {
  const auto fits = [](const StridedVectors& vectors) { return !vectors || vectors.is_packed_floats(); };
  return is_local && !index && !mask && !inverse_mass && fits(position) && fits(velocity) && fits(safe);
}

Outcome read_particles(const bodice_particles* given, HostParticles& out) {
  bodice_particles particles;
  BODICE_CHECK(read(given, particles));
  if (particles.count > BODICE_MAX_PARTICLES || particles.elements > BODICE_MAX_PARTICLES)
    return invalid(
        "There are " + std::to_string(std::max(particles.count, particles.elements)) + " particles.",
        "Pass at most BODICE_MAX_PARTICLES a call.");
  if (particles.space != BODICE_WORLD && particles.space != BODICE_LOCAL)
    return invalid("bodice_particles.space is " + std::to_string(particles.space) + ".",
                   "Give BODICE_WORLD or BODICE_LOCAL.");
  const std::size_t elements = particles.index ? particles.elements : particles.count;
  BODICE_CHECK(read_vectors(particles.position, elements, "bodice_particles.position", out.position));
  BODICE_CHECK(read_vectors(particles.velocity, elements, "bodice_particles.velocity", out.velocity));
  BODICE_CHECK(read_vectors(particles.safe, elements, "bodice_particles.safe", out.safe));
  BODICE_CHECK(read_scalars(particles.inverse_mass, elements, "bodice_particles.inverse_mass",
                            out.inverse_mass, out.mass_is_double));
  BODICE_CHECK(read_elements(const_cast<std::uint8_t*>(particles.mask), particles.mask_stride, 1, elements,
                             "bodice_particles.mask", out.mask));
  if (particles.count > 0 && !out.position)
    return invalid("bodice_particles.position has no arrays.", "Set position.x, or x, y and z.");
  for (std::size_t i = 0; particles.index && i < particles.count; ++i)
    if (particles.index[i] >= elements)
      return invalid("bodice_particles.index[" + std::to_string(i) + "] is " +
                         std::to_string(particles.index[i]) + ", and there are " + std::to_string(elements) +
                         " elements.",
                     "Set `elements` to the length of the arrays, and keep the index below it.");
  out.count = particles.count;
  out.index = particles.index;
  out.is_local = particles.space == BODICE_LOCAL;
  return {};
}

EngineParticles::EngineParticles(const HostParticles& host, const double (&origin)[3],
                                 bodice_workspace& workspace, bool drop_pinned)
    : host_(host), context_(workspace.context->engine_context()) {
  for (int axis = 0; axis < 3; ++axis) origin_[axis] = host.is_local ? 0.0 : origin[axis];
  const auto floats = [](const Strided& numbers) { return reinterpret_cast<float*>(numbers.data); };
  engine_.count = host.count;
  const bool with_velocity = drop_pinned && host.velocity, with_safe = drop_pinned && host.safe;
  if (host.fits_engine()) {
    copied_ = false;
    engine_.x = floats(host.position.x);
    engine_.y = floats(host.position.y);
    engine_.z = floats(host.position.z);
    if (with_velocity) {
      engine_.vx = floats(host.velocity.x);
      engine_.vy = floats(host.velocity.y);
      engine_.vz = floats(host.velocity.z);
    }
    if (with_safe) {
      engine_.safe_x = floats(host.safe.x);
      engine_.safe_y = floats(host.safe.y);
      engine_.safe_z = floats(host.safe.z);
    }
    return;
  }
  if (drop_pinned && (host.mask || host.inverse_mass)) {
    std::uint32_t* element = workspace.element.reserve(host.count);
    engine_.count = 0;
    for (std::size_t i = 0; i < host.count; ++i)
      if (const std::size_t e = host.element(i); !host.is_pinned(e))
        element[engine_.count++] = static_cast<std::uint32_t>(e);
    pinned_ = host.count - engine_.count;
    element_ = element;
  }
  const std::size_t length = (engine_.count + kLine - 1) / kLine * kLine;
  const std::size_t moved = drop_pinned ? length * (3 + 3 * with_velocity) : 0;
  float* next = workspace.numbers.reserve(length * (3 + 3 * with_velocity + 3 * with_safe) + moved);
  const float* const first = next;
  const auto copy = [&](const StridedVectors& from, bool is_position, float*(&to)[3]) {
    for (float*& array : to) {
      array = next;
      next += length;
    }
    copy_in(from, is_position, to);
  };
  float *x[3], *v[3], *s[3];
  copy(host.position, true, x);
  engine_.x = x[0], engine_.y = x[1], engine_.z = x[2];
  if (with_velocity) {
    copy(host.velocity, false, v);
    engine_.vx = v[0], engine_.vy = v[1], engine_.vz = v[2];
  }
  if (with_safe) {
    copy(host.safe, true, s);
    engine_.safe_x = s[0], engine_.safe_y = s[1], engine_.safe_z = s[2];
  }
  before_ = std::copy_n(first, moved, next) - moved;
  length_ = length;
}

void EngineParticles::copy_in(const StridedVectors& from, bool is_position, float* (&to)[3]) {
  const double shift[3] = {is_position ? origin_[0] : 0.0, is_position ? origin_[1] : 0.0,
                           is_position ? origin_[2] : 0.0};
  with_scalar(from.is_double, [&](auto scalar) {
    using Scalar = decltype(scalar);
    engine::parallel_for(context_, engine_.count, kParticlesATask, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const std::size_t e = element(i);
        to[0][i] = inward(from.x.get<Scalar>(e), shift[0]);
        to[1][i] = inward(from.y.get<Scalar>(e), shift[1]);
        to[2][i] = inward(from.z.get<Scalar>(e), shift[2]);
      }
    });
  });
}

void EngineParticles::write_back() const {
  if (!copied_) return;
  // Serial: an element may stand in the index twice, and which of its values is kept must not depend on
  // threads.
  const Changed changed{element_ ? element_ : host_.index, engine_.count, before_, length_};
  with_scalar(host_.position.is_double, [&](auto scalar) {
    write_changed<decltype(scalar)>(changed, {engine_.x, engine_.y, engine_.z}, origin_, host_.position);
  });
  if (!engine_.vx) return;
  const Changed velocities{changed.index, changed.count, before_ + 3 * length_, length_};
  with_scalar(host_.velocity.is_double, [&](auto scalar) {
    write_changed<decltype(scalar)>(velocities, {engine_.vx, engine_.vy, engine_.vz}, {0.0, 0.0, 0.0},
                                    host_.velocity);
  });
}

}  // namespace bodice::capi
