// The first part of a substep: velocities and predicted positions.
#pragma once

#include <cstdint>
#include <span>

#include "base/particles.hpp"
#include "motion/aerodynamics.hpp"

namespace bodice::inline v0_1::cloth {

/// How particles are predicted.
struct Prediction {
  float substep_s = 0.0f;
  float damping_per_s = 0.0f;
  float top_speed_m_s = 0.0f;
};

/// Accelerates the particles from `begin` on, a multiple of four, and writes the predicted position of one to
/// each point; pinned and sleeping particles keep their velocities. Returns FrameLimit bits.
std::uint32_t predict(const Environment& environment, const Air& air, const Prediction& how,
                      std::size_t begin, Particles& particles, std::span<Point> points);

}  // namespace bodice::cloth
