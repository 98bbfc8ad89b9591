// The first part of a substep: velocities and predicted positions.
#pragma once

#include "base/particles.hpp"
#include "motion/aerodynamics.hpp"

namespace bodice::inline v0_1::cloth {

/// How particles are predicted.
struct Prediction {
  float substep_s = 0.0f;
  float damping_per_s = 0.0f;
  float top_speed_m_s = 0.0f;
};

/// Accelerates the particles [begin, end) and writes their predicted positions from at[0] on; pinned and
/// sleeping particles keep their velocities. `begin` is a multiple of four. Returns FrameLimit bits.
std::uint32_t predict(const Environment& environment, const Air& air, const Prediction& how,
                      std::size_t begin, std::size_t end, Particles& particles, Point* at);

}  // namespace bodice::cloth
