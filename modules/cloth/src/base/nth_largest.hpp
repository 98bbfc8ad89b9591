// One value of many by its rank, by all workers.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <bodice/engine/context.hpp>

namespace bodice::cloth {

/// What a selection works in; keep it, so that a warm call allocates nothing.
struct Selection {
  std::vector<std::uint32_t> counts;  ///< of leading digits, a row a block
  std::vector<float> near;            ///< as many as values: those with the digit of the one sought
};

/// For at most this many values.
Selection make_selection(std::size_t values);

/// The value that `rank` others are larger than or stand before (0: the largest), values below zero taken as
/// zero; zero if there are no more than `rank`. Two passes over the values, O(#values).
float nth_largest(const engine::Context& context, std::span<const float> values, std::size_t rank,
                  Selection& selection);

}  // namespace bodice::cloth
