#include "cell_grid.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

namespace bodice::cloth {
namespace {

constexpr int kFewestBits = 2;         // three neighbours must be three slots
constexpr int kSlotsAParticle = 8;     // more would cost more to clear than collisions of far cells do
constexpr float kFarthestCell = 1e8f;  // beyond it, integers would overflow

int bits_for(float extent_m, float cell_m) {
  const float cells = std::clamp(extent_m / cell_m + 3.0f, 1.0f, 1024.0f);
  return std::max(kFewestBits, static_cast<int>(std::bit_width(static_cast<unsigned>(cells))));
}

}  // namespace

CellGrid::CellGrid(std::array<int, 3> bits, float cell_m, std::size_t points)
    : bits_(bits), per_cell_(1.0f / cell_m) {
  for (std::size_t axis = 0; axis < 3; ++axis) mask_[axis] = (std::size_t{1} << bits[axis]) - 1;
  begin_.assign((std::size_t{1} << (bits[0] + bits[1] + bits[2])) + 1, 0);
  slot_of_.assign(points, 0);
  entry_.resize(points);
}

CellGrid::Cell CellGrid::cell_of(const Point& at) const {
  auto cell = [&](float value) {
    return static_cast<int>(std::floor(std::clamp(value * per_cell_, -kFarthestCell, kFarthestCell)));
  };
  return {cell(at.x), cell(at.y), cell(at.z)};
}

void CellGrid::fill(std::span<const Point> points) {
  std::fill(begin_.begin(), begin_.end(), 0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Cell c = cell_of(points[i]);
    slot_of_[i] = static_cast<Index>(row_of(c.y, c.z) + (static_cast<std::size_t>(c.x) & mask_[0]));
    ++begin_[slot_of_[i]];
  }
  std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());  // where each slot ends
  for (std::size_t i = points.size(); i-- > 0;)
    entry_[--begin_[slot_of_[i]]] = {points[i], static_cast<Index>(i)};
}

CellGrid make_cell_grid(std::span<const Point> points, float cell_m) {
  if (!(cell_m > 0.0f)) return {};
  Point low = points[0], high = points[0];
  for (const Point& p : points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z), 0.0f};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z), 0.0f};
  }
  std::array<int, 3> bits = {bits_for(high.x - low.x, cell_m), bits_for(high.y - low.y, cell_m),
                             bits_for(high.z - low.z, cell_m)};
  const int most =
      std::max(3 * kFewestBits, static_cast<int>(std::bit_width(kSlotsAParticle * points.size())));
  while (bits[0] + bits[1] + bits[2] > most) --*std::max_element(bits.begin(), bits.end());
  return {bits, cell_m, points.size()};
}

}  // namespace bodice::cloth
