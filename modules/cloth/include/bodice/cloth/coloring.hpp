// Grouping of constraints for a parallel solution.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <bodice/geometry/types.hpp>

namespace bodice::inline v0_1::cloth {

/// Constraints grouped so that no two of a color share a particle. Those of a color can be solved in
/// parallel, and the result does not depend on the number of workers.
struct Coloring {
  std::vector<std::uint32_t> order;  ///< #C: constraints by color, ascending within a color
  std::vector<std::uint32_t> begin;  ///< #colors + 1: offsets into order

  std::size_t colors() const { return begin.empty() ? 0 : begin.size() - 1; }
};

/// First-fit greedy coloring in the order of the input, hence deterministic, with at most arity * (valence -
/// 1) + 1 colors. `particles` holds `arity` indices (< particle_count) for each constraint. O(#C arity) for
/// valences below 64.
Coloring color(std::span<const geometry::Index> particles, std::size_t arity, std::size_t particle_count);

}  // namespace bodice::cloth
