// Samples of edges and triangles near the body, chosen once a frame.
//
// Their density follows from curvature. A distance to a body that a ball of radius rho can touch from inside
// at every point is semiconcave, with constant 1 / rho. So it lies below the interpolation of its values at
// the corners of a triangle by up to r^2 / (2 rho), r the circumradius, and along an edge by up to e^2 / (8
// rho); unions keep that, because the least of semiconcave functions is one. The turn of the normals from one
// end to the other measures e^2 / rho. An edge is cut into parts until this error is below a tolerance. It
// has at least the samples of a fixed spacing, because a sharp feature may rise between its corners.
// Based on: Piermarco Cannarsa, Carlo Sinestrari. Semiconcave Functions, Hamilton-Jacobi Equations, and
// Optimal Control. 2004. - section 2.2 (distances).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <bodice/collision/collider.hpp>
#include <bodice/engine/context.hpp>

#include "faces/elements.hpp"

namespace bodice::inline v0_1::cloth {

/// A point of the cloth with the body's distance near it, to first order.
struct alignas(64) FaceSample {
  Index particle[3] = {};
  float weight[2] = {};     ///< barycentric weights of the first two particles
  float at[3] = {};         ///< where the distance was queried, in the body's pose at the end of the frame
  float normal[3] = {};     ///< normal of the body there
  float distance_m = 0.0f;  ///< distance to the body there; the query band where nothing is within it
  float shift[3] = {};      ///< its shift for a whole frame, meters, as BodyMotion::shift of a particle
  float keep_m = 0.0f;      ///< distance to keep; less beside a pin that the host holds nearer
};

/// Lengths that decide which elements are sampled, and how densely.
struct SampleRules {
  float keep_m = 0.0f;                ///< distance that the cloth keeps from the proxy
  float sag_m = 0.0f;                 ///< largest error of the distance interpolated between samples
  float spacing_m = 0.0f;             ///< the widest spacing of samples near the body
  float slope = 1.0f, rise_m = 0.0f;  ///< a distance falls by at most slope times the path, plus rise_m
  float frame_s = 0.0f;
  float fall_m = 0.0f;  ///< travel that gravity adds in a frame
};

/// The distance up to which samples are queried. A sample that is farther away gets this distance.
inline float band_of(const SampleRules& rules) {
  return rules.keep_m + rules.rise_m + rules.spacing_m;
}

/// The parts of BodyMotion that samples use: the body's motion in a frame near each particle (#P).
struct MotionNearParticles {
  std::span<const Point> shift, rotation;
  std::span<float> along_pushes_m2;
  float follow = 0.0f;
  bool moving = false;  ///< whether any of it is not zero
};

/// The body near the particles in a frame.
struct BodyNearParticles {
  const collision::Collider& body;
  std::span<const collision::Contact> nearest;  ///< #P: contacts of the particles, shifted as the body moves
  const MotionNearParticles& motion;
};

/// The room that the body leaves a particle in a frame.
struct ParticleRoom {
  /// Distance to the body when the frame begins; a large value beyond the query band.
  float distance_m = 0.0f;
  float reach_m = 0.0f;  ///< bound on its path in the frame, relative to the body
};

/// Samples [begin, end).
struct SampleRange {
  std::uint32_t begin = 0, end = 0;
};

/// The samples of a frame, in the order of their elements.
struct FaceSamples {
  std::vector<FaceSample> all;
  std::vector<std::uint32_t> begin;  ///< #elements + 1: first sample of each
  /// #elements: the number of parts of each edge; 0: the element is not near the body.
  std::vector<std::uint8_t> parts;
  /// #elements: the parts that the curvature at the last frame's samples requires.
  std::vector<std::uint8_t> wanted;
  std::vector<std::size_t> before_block;  ///< number of samples before each block of elements
  std::vector<ParticleRoom> room;         ///< #P
  std::size_t most = 0;                   ///< number of samples that memory is reserved for

  SampleRange of_run(const Elements& elements, std::size_t run) const {
    return {begin[elements.run_begin[run]], begin[elements.run_begin[run + 1]]};
  }
};

/// Makes the state for these elements and a number of particles, with memory for `most` samples.
FaceSamples make_face_samples(const Elements& elements, std::size_t particles, std::size_t most);

/// The number of samples that the widest spacing gives for the garment at rest.
std::size_t count_at_rest(const Elements& elements, const Particles& particles, float spacing_m);

/// Chooses the samples of a frame and queries them. Where they exceed the reserved memory, all are spaced
/// more widely. Allocates nothing; the result is the same for any number of workers.
void place_samples(const engine::Context& context, const BodyNearParticles& near, const SampleRules& rules,
                   const Elements& elements, const Particles& particles, FaceSamples& samples);

/// Gives a sample the distance, the normal and the motion of a contact.
void set_contact(const collision::Collider& body, const MotionNearParticles& motion,
                 const collision::Contact& contact, float frame_s, FaceSample& sample);

/// Queries the listed samples at positions (x, y, z) in the body's pose at the end of the frame.
struct SampleQuery {
  static constexpr std::size_t kMost = 256;
  std::uint32_t sample[kMost];
  float x[kMost], y[kMost], z[kMost];
  collision::Contact contact[kMost];
  std::size_t count = 0;

  bool is_full() const { return count == kMost; }
  void add(std::uint32_t s, Float4 at) {
    sample[count] = s, x[count] = at[0], y[count] = at[1], z[count++] = at[2];
  }
  /// Queries within `band_m` and writes distance, normal and motion of each sample.
  void run(const collision::Collider& body, const SampleRules& rules, const MotionNearParticles& motion,
           std::span<FaceSample> samples);
};

inline Float4 vector_of(const float (&v)[3]) {
  return Float4{v[0], v[1], v[2], 0.0f};
}
/// The weights of a sample's three particles, sum 1.
inline std::array<float, 3> weights_of(const FaceSample& s) {
  return {s.weight[0], s.weight[1], 1.0f - s.weight[0] - s.weight[1]};
}
/// The position of a sample, given those of the particles.
inline Float4 position(const FaceSample& s, std::span<const Point> at) {
  return xyz(s.weight[0] * load(at[s.particle[0]]) + s.weight[1] * load(at[s.particle[1]]) +
             (1.0f - s.weight[0] - s.weight[1]) * load(at[s.particle[2]]));
}

}  // namespace bodice::cloth
