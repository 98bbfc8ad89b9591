#include "base/spatial_order.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include <bodice/geometry/detail/morton.hpp>

namespace bodice::inline v0_1::fitting {
namespace {

using Coded = std::vector<std::pair<std::uint32_t, std::uint32_t>>;  // code, index

/// A stable radix sort by codes of 30 bits, ten bits at a time.
void sort_by_digits(Coded& coded) {
  constexpr int kBits = geometry::kMortonBits;
  Coded sorted(coded.size());
  for (int shift = 0; shift < 3 * kBits; shift += kBits) {
    std::array<std::uint32_t, (1u << kBits) + 1> next{};
    const auto digit = [&](const Coded::value_type& c) { return c.first >> shift & ((1u << kBits) - 1); };
    for (const auto& c : coded) ++next[digit(c) + 1];
    for (std::size_t k = 1; k < next.size(); ++k) next[k] += next[k - 1];
    for (const auto& c : coded) sorted[next[digit(c)]++] = c;
    std::swap(coded, sorted);
  }
}

}  // namespace

std::vector<std::uint32_t> spatial_order(std::span<const geometry::Vec3> points) {
  geometry::Box box;
  for (const auto& p : points) box.extend(p);
  const geometry::Vec3 scale = 1023.0 * box.size().cwiseMax(1e-300).cwiseInverse();
  Coded code_of;
  code_of.reserve(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const auto cell = [&](int j) {
      return static_cast<std::uint32_t>(std::clamp((points[i][j] - box.low[j]) * scale[j], 0.0, 1023.0));
    };
    code_of.emplace_back(geometry::morton_code(cell(0), cell(1), cell(2)), i);
  }
  sort_by_digits(code_of);
  std::vector<std::uint32_t> order;
  order.reserve(points.size());
  for (const auto& [code, i] : code_of) order.push_back(i);
  return order;
}

}  // namespace bodice::fitting
