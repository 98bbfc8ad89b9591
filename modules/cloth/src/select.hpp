// One value of many by its rank, by all workers.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <bodice/engine/context.hpp>

namespace bodice::cloth {

/// Counts of digits, a row a block; keep it, so that a warm call allocates nothing.
using DigitCounts = std::vector<std::uint32_t>;

DigitCounts make_digit_counts();

/// The value that `rank` others are larger than or stand before (0: the largest), values below zero taken as
/// zero; zero if there are no more than `rank`. Four passes over the values, O(#values).
float nth_largest(const engine::Context& context, std::span<const float> values, std::size_t rank,
                  DigitCounts& counts);

}  // namespace bodice::cloth
