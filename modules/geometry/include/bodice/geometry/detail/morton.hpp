// Morton codes: the bits of three cell numbers interleaved. Sorting by them keeps neighbors in space
// together.
#pragma once

#include <cstdint>

#include <bodice/engine/version.hpp>

namespace bodice::inline v0_1::geometry {

/// Bits that a Morton code takes of each cell number.
inline constexpr int kMortonBits = 10;

/// Moves bit i of the low ten bits to bit 3 i. Precondition: v < 2^10.
constexpr std::uint32_t spread_bits(std::uint32_t v) {
  v = (v | v << 16) & 0x030000FFu;
  v = (v | v << 8) & 0x0300F00Fu;
  v = (v | v << 4) & 0x030C30C3u;
  return (v | v << 2) & 0x09249249u;
}

/// The code of cell (x, y, z): 30 bits, x in the lowest of each three. Precondition: all below 2^10.
constexpr std::uint32_t morton_code(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  return spread_bits(x) | spread_bits(y) << 1 | spread_bits(z) << 2;
}

}  // namespace bodice::geometry
