#pragma once

#include "base/particles.hpp"
#include "motion/aerodynamics.hpp"

namespace bodice::cloth {

struct Prediction {
  float substep_s = 0.0f;
  float damping_per_s = 0.0f;
  float top_speed_m_s = 0.0f;
};

/// Accelerates the particles [begin, end) and writes where their velocities bring them, from at[0] on; pinned
/// ones and sleepers keep theirs. Begin is a multiple of four. Returns FrameLimit bits.
std::uint32_t predict(const Environment& environment, const Air& air, const Prediction& how,
                      std::size_t begin, std::size_t end, Particles& particles, Point* at);

}  // namespace bodice::cloth
