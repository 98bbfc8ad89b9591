#include "cell_grid.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include <bodice/engine/parallel.hpp>

#include "tiny.hpp"

namespace bodice::cloth {
namespace {

constexpr int kFewestBits = 12;        // 16 cells a row, 256 rows: near ones stay apart
constexpr int kSlotsAParticle = 8;     // more would cost more to clear than meetings of far cells do
constexpr double kGolden = 0.381966;   // skew of the lattice, in rows: its shortest vector is the longest
constexpr float kFarthestCell = 1e8f;  // beyond it, integers would overflow

}  // namespace

CellGrid::CellGrid(float cell_m, std::size_t points) {
  if (!(cell_m > 0.0f)) return;
  const int bits = std::max(kFewestBits, static_cast<int>(std::bit_width(kSlotsAParticle * points)));
  x_bits_ = bits / 3;
  x_mask_ = (std::size_t{1} << x_bits_) - 1;
  const std::size_t rows = std::size_t{1} << (bits - x_bits_);
  row_mask_ = rows - 1;
  skew_ = static_cast<std::size_t>(kGolden * static_cast<double>(rows));
  per_cell_ = 1.0f / cell_m;
  begin_.assign((std::size_t{1} << bits) + 1, 0);
  slot_of_.assign(points, 0);
  entry_.resize(points);
}

CellGrid::Cell CellGrid::cell_of(const Point& at) const {
  auto cell = [&](float value) {
    return static_cast<int>(std::floor(std::clamp(value * per_cell_, -kFarthestCell, kFarthestCell)));
  };
  return {cell(at.x), cell(at.y), cell(at.z)};
}

void CellGrid::fill(const engine::Context& context, std::span<const Point> points) {
  engine::parallel_for(context, points.size(), kParticleGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Cell c = cell_of(points[i]);
      slot_of_[i] = static_cast<Index>(row_of(c.y, c.z) + (static_cast<std::size_t>(c.x) & x_mask_));
    }
  });
  std::fill(begin_.begin(), begin_.end(), 0);
  for (const Index slot : slot_of_) ++begin_[slot];
  std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());  // where each slot ends
  for (std::size_t i = points.size(); i-- > 0;)
    entry_[--begin_[slot_of_[i]]] = {points[i], static_cast<Index>(i)};
}

}  // namespace bodice::cloth
