// Constraints of one colour share no particle, so eight at a time can be read, solved and written. Loops of a
// fixed count over plain arrays are what compilers turn into vector code without intrinsics.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <type_traits>

#include <bodice/engine/parallel.hpp>

namespace bodice::cloth {

inline constexpr int kPackLanes = 8;
/// Constraints a task; the cost of a task is a few microseconds. A multiple of the lanes.
inline constexpr std::size_t kConstraintGrain = 2048;
/// Particles a task in loops without gathers.
inline constexpr std::size_t kParticleGrain = 4096;

/// Square metres under a root: the length of a collapsed edge, so that it divides nothing by zero.
inline constexpr float kTinyLength2 = 1e-24f;
/// Inverse kilograms: a constraint between pinned particles divides nothing by zero.
inline constexpr float kTinyWeight = 1e-12f;

template <int kLanes>
struct Lanes {
  alignas(32) float value[static_cast<std::size_t>(kLanes)];
  float& operator[](int k) { return value[k]; }
  float operator[](int k) const { return value[k]; }
};

/// Calls solve(first, integral_constant<int, 8 or 1>) for the constraints of each colour, colour by colour.
/// Packs are counted from the start of the colour, so that they do not depend on the workers.
template <class Solve>
void for_each_pack(const engine::Context& context, std::span<const std::uint32_t> color_begin,
                   Solve&& solve) {
  const std::size_t colors = color_begin.empty() ? 0 : color_begin.size() - 1;
  for (std::size_t c = 0; c < colors; ++c) {
    const std::size_t base = color_begin[c];
    auto solve_block = [&](std::size_t begin, std::size_t end) {
      std::size_t i = begin;
      for (; i + kPackLanes <= end; i += kPackLanes)
        solve(base + i, std::integral_constant<int, kPackLanes>());
      for (; i < end; ++i) solve(base + i, std::integral_constant<int, 1>());
    };
    engine::parallel_for(context, color_begin[c + 1] - base, kConstraintGrain, solve_block);
  }
}

}  // namespace bodice::cloth
