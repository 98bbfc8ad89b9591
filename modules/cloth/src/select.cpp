// Based on: Donald Knuth. The Art of Computer Programming 3. 1998. - section 5.2.5, radix exchange, of which
// only the digit's bucket that holds the rank is followed. The bits of floats from zero up order as they do.
#include "select.hpp"

#include <algorithm>
#include <bit>

#include <bodice/engine/parallel.hpp>

#include "tiny.hpp"

namespace bodice::cloth {
namespace {

constexpr int kDigitBits = 8;
constexpr std::size_t kDigits = std::size_t{1} << kDigitBits;
constexpr std::size_t kBlocks = 32;

// Those with the digits found so far, by their next digit; a row each block. What is below zero counts as
// zero. Without branches: half of a garment's edges are shortened, in no order that a processor could guess.
void count_digits(std::span<const float> values, std::size_t begin, std::size_t end, std::uint64_t found,
                  int shift, std::uint32_t* row) {
  std::fill_n(row, kDigits, 0u);
  for (std::size_t i = begin; i < end; ++i) {
    const auto key = std::uint64_t{std::bit_cast<std::uint32_t>(values[i] > 0.0f ? values[i] : 0.0f)};
    row[(key >> shift) % kDigits] += key >> (shift + kDigitBits) == found;
  }
}

// The digit whose values hold the rank; `rank` becomes that among them.
std::uint32_t digit_of_rank(const DigitCounts& counts, std::size_t blocks, std::size_t& rank) {
  for (std::size_t digit = kDigits; digit-- > 0;) {
    std::size_t here = 0;
    for (std::size_t b = 0; b < blocks; ++b) here += counts[b * kDigits + digit];
    if (rank < here) return static_cast<std::uint32_t>(digit);
    rank -= here;
  }
  return 0;
}

}  // namespace

DigitCounts make_digit_counts() {
  return DigitCounts(kBlocks * kDigits);
}

float nth_largest(const engine::Context& context, std::span<const float> values, std::size_t rank,
                  DigitCounts& counts) {
  if (rank >= values.size()) return 0.0f;
  const std::size_t grain = std::max(kParticleGrain, values.size() / kBlocks + 1);
  const std::size_t blocks = engine::block_count(values.size(), grain);
  std::uint32_t found = 0;
  for (int shift = 32 - kDigitBits; shift >= 0; shift -= kDigitBits) {
    engine::parallel_for(context, values.size(), grain, [&](std::size_t begin, std::size_t end) {
      count_digits(values, begin, end, found, shift, &counts[begin / grain * kDigits]);
    });
    found = (found << kDigitBits) | digit_of_rank(counts, blocks, rank);
  }
  return std::bit_cast<float>(found);
}

}  // namespace bodice::cloth
