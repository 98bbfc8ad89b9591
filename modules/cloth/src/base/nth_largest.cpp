// Based on: Donald Knuth. The Art of Computer Programming 3. 1998. - section 5.2.5 (radix exchange)
// Differs: only the bucket that holds the rank is followed, and it is partitioned once it is small. Floats of
// at least zero have the same order as their bits.
#include "base/nth_largest.hpp"

#include <algorithm>
#include <bit>
#include <functional>

#include <bodice/engine/parallel.hpp>

namespace bodice::inline v0_1::cloth {
namespace {

constexpr int kDigitBits =
    11;  // the exponent and three bits more, so that values of a bucket differ by an eighth
constexpr std::size_t kDigits = std::size_t{1} << kDigitBits;
constexpr std::size_t kBlocks = 8;  // tasks; each has a row of counts
constexpr std::size_t kLeastGrain =
    4096;  // with fewer values a task, adding up the rows costs more than counting

float from_zero(float value) {
  return value > 0.0f ? value : 0.0f;
}

std::uint32_t digit(float value) {
  return std::bit_cast<std::uint32_t>(from_zero(value)) >> (32 - kDigitBits);
}

// This loop has no branches, because half of a garment's edges are shortened, in an order that no processor
// predicts.
void count_digits(std::span<const float> values, std::uint32_t* row) {
  std::fill_n(row, kDigits, 0u);
  for (const float value : values) ++row[digit(value)];
}

// The digit of the value at this rank; `rank` becomes the rank among the values with that digit.
std::uint32_t digit_of_rank(std::vector<std::uint32_t>& counts, std::size_t blocks, std::size_t& rank) {
  for (std::size_t b = 1; b < blocks; ++b)
    for (std::size_t d = 0; d < kDigits; ++d) counts[d] += counts[b * kDigits + d];
  for (std::size_t d = kDigits; d-- > 0;) {
    if (rank < counts[d]) return static_cast<std::uint32_t>(d);
    rank -= counts[d];
  }
  return 0;
}

// Copies the values with this digit to `near`, which has room for all values; returns their number.
std::uint32_t copy_near(std::span<const float> values, std::uint32_t sought, float* near) {
  std::uint32_t count = 0;
  for (const float value : values) {
    near[count] = from_zero(value);
    count += digit(value) == sought;
  }
  return count;
}

}  // namespace

Selection make_selection(std::size_t values) {
  return {std::vector<std::uint32_t>(kBlocks * kDigits), std::vector<float>(values)};
}

float nth_largest(const engine::Context& context, std::span<const float> values, std::size_t rank,
                  Selection& s) {
  if (rank >= values.size()) return 0.0f;
  const std::size_t grain = std::max(kLeastGrain, values.size() / kBlocks + 1);
  const std::size_t blocks = engine::block_count(values.size(), grain);
  engine::parallel_for(context, values.size(), grain, [&](std::size_t begin, std::size_t end) {
    count_digits(values.subspan(begin, end - begin), &s.counts[begin / grain * kDigits]);
  });
  const std::uint32_t sought = digit_of_rank(s.counts, blocks, rank);
  engine::parallel_for(context, values.size(), grain, [&](std::size_t begin, std::size_t end) {
    s.counts[begin / grain] = copy_near(values.subspan(begin, end - begin), sought, &s.near[begin]);
  });
  auto last = s.near.begin();
  for (std::size_t b = 0; b < blocks; ++b)
    last = std::copy_n(s.near.begin() + static_cast<std::ptrdiff_t>(b * grain), s.counts[b], last);
  const auto found = s.near.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(s.near.begin(), found, last, std::greater<>());
  return *found;
}

}  // namespace bodice::cloth
