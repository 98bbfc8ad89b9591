// Pushes a sample of an edge or triangle out of the body by its corners.
#pragma once

#include <algorithm>

#include "faces/face_contact.hpp"

namespace bodice::inline v0_1::cloth {

/// The position of a sample, shifted to the body's pose at the end of the frame.
inline Float4 in_end_pose(const FaceSample& s, std::span<const Point> now, float remaining) {
  return position(s, now) + remaining * vector_of(s.shift);
}

/// Distance of a sample at this position, to first order.
inline float distance_at(const FaceSample& s, Float4 where) {
  return s.distance_m + dot(vector_of(s.normal), where - vector_of(s.at));
}

/// No corner moves farther than this multiple of the push. A sample near a pinned corner could otherwise move
/// only if the other corners moved many times as far, which would tear the cloth.
inline constexpr float kLongestLever = 2.0f;

/// The divisor of a push: corner c moves by push times its inverse mass times its weight, divided by this.
inline float yielding_of(const std::array<float, 3>& weight, const std::array<float, 3>& inverse_mass) {
  float all = 0.0f, most = 0.0f;
  for (std::size_t c = 0; c < 3; ++c) {
    const float by = inverse_mass[c] * weight[c];
    all += by * weight[c];
    most = std::max(most, by);
  }
  return std::max(all, most / kLongestLever);
}

/// Moves the corners of a sample that is too near. Returns false for a sample that is not, or is so deep that
/// contact of its particles moves it.
bool push_out(const FaceSample& sample, const FaceSubstep& substep, const Particles& particles,
              FaceContact& faces);

}  // namespace bodice::cloth
