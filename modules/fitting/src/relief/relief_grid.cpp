#include "relief/relief_grid.hpp"

#include <utility>

namespace bodice::inline v0_1::fitting {
namespace {

/// The node that a step across the border leads to.
std::pair<int, int> wrapped(int i, int j, int n) {
  const int last = n - 1;
  if (i < 0) i = -i, j = last - j;
  if (i > last) i = 2 * last - i, j = last - j;
  if (j < 0) j = -j, i = last - i;
  if (j > last) j = 2 * last - j, i = last - i;
  return {i, j};
}

/// The node that represents all border nodes of the same direction.
std::pair<int, int> canonical(int i, int j, int n) {
  const int last = n - 1;
  if ((i == 0 || i == last) && (j == 0 || j == last)) return {0, 0};
  if ((i == 0 || i == last) && j > last - j) j = last - j;
  if ((j == 0 || j == last) && i > last - i) i = last - i;
  return {i, j};
}

}  // namespace

ReliefGrid make_relief_grid(int n) {
  ReliefGrid grid;
  grid.n = n;
  std::vector<std::uint32_t> number(static_cast<std::size_t>(n * n), ~0u);
  grid.unknown_of.resize(number.size());
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const auto [ci, cj] = canonical(i, j, n);
      std::uint32_t& id = number[static_cast<std::size_t>(cj * n + ci)];
      if (id == ~0u) id = static_cast<std::uint32_t>(grid.unknowns++);
      grid.unknown_of[static_cast<std::size_t>(j * n + i)] = id;
    }
  const auto unknown = [&](int i, int j) {
    const auto [wi, wj] = wrapped(i, j, n);
    return grid.unknown_of[static_cast<std::size_t>(wj * n + wi)];
  };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      if (canonical(i, j, n) != std::pair(i, j)) continue;
      grid.second.push_back({unknown(i - 1, j), unknown(i, j), unknown(i + 1, j)});
      grid.second.push_back({unknown(i, j - 1), unknown(i, j), unknown(i, j + 1)});
    }
  return grid;
}

}  // namespace bodice::fitting
