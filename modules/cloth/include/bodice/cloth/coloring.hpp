#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <bodice/geometry/types.hpp>

namespace bodice::cloth {

/// Constraints grouped so that no two of a color share a particle: a color can be solved in parallel, and
/// the result does not depend on who solves what.
struct Coloring {
  std::vector<std::uint32_t> order;  ///< #C, constraints by color, ascending inside one
  std::vector<std::uint32_t> begin;  ///< #colors + 1, offsets into order

  std::size_t colors() const { return begin.empty() ? 0 : begin.size() - 1; }
};

/// First-fit greedy coloring in input order, hence deterministic; at most arity * (valence - 1) + 1 colors.
/// `particles` holds `arity` indices (< particle_count) a constraint. O(#C arity) for valences below 64.
Coloring color(std::span<const geometry::Index> particles, std::size_t arity, std::size_t particle_count);

}  // namespace bodice::cloth
