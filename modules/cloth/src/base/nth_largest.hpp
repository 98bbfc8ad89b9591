// The value of a given rank among many, found by all workers together.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <bodice/engine/context.hpp>

namespace bodice::inline v0_1::cloth {

/// The memory of a selection; it is kept, so that a warm call allocates nothing.
struct Selection {
  std::vector<std::uint32_t> counts;  ///< counts of leading digits, a row for each task
  std::vector<float> near;            ///< room for all values: those with the digit of the result
};

/// Memory for selections from at most `values` values.
Selection make_selection(std::size_t values);

/// The value at position `rank` if the values are sorted downward (0: the largest), with values below zero
/// counted as zero. Zero if there are not more than `rank` values. Two passes over the values, O(#values).
float nth_largest(const engine::Context& context, std::span<const float> values, std::size_t rank,
                  Selection& selection);

}  // namespace bodice::cloth
