// The cells of a cubic lattice that a level set crosses.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <unordered_map>
#include <vector>

#include <bodice/engine/context.hpp>
#include <bodice/geometry/types.hpp>

namespace bodice::inline v0_1::proxy {

using geometry::Vec3;
using LatticePoint = std::array<int, 3>;

/// A cell. Its corner k lies at `at` + (k & 1, k >> 1 & 1, k >> 2) and is stored as the number of its value.
struct Cell {
  LatticePoint at;
  std::array<std::uint32_t, 8> corner;
};

class CrossedCells {
 public:
  static constexpr double kMostCellsAcross = 1e6;  // three such numbers fit a 64-bit word

  CrossedCells(const Vec3& origin, double cell_m) : origin_(origin), cell_m_(cell_m) {}

  /// Finds all cells that have both signs and are joined to one near a seed through faces that have both.
  /// Returns false if they are more than fit. Cells and corners are numbered in the order of discovery, which
  /// does not depend on the workers.
  bool find(const engine::Context& context, const std::vector<Vec3>& seeds,
            const std::function<double(const Vec3&)>& distance);

  const std::vector<Cell>& cells() const { return cells_; }
  double value(const Cell& cell, int corner) const {
    return value_[cell.corner[static_cast<std::size_t>(corner)]];
  }
  Vec3 position(const LatticePoint& at, int corner = 0) const;
  /// The number of a cell that was found.
  std::uint32_t index_of(const LatticePoint& at) const;

 private:
  std::vector<Cell> numbered(const std::vector<LatticePoint>& points);
  void evaluate(const engine::Context& context, const std::function<double(const Vec3&)>& distance);
  void add_beyond(const Cell& cell, std::vector<LatticePoint>& next);
  void add(const LatticePoint& at, std::vector<LatticePoint>& next);

  Vec3 origin_;
  double cell_m_;
  std::vector<Cell> cells_;
  std::unordered_map<std::uint64_t, std::uint32_t> cell_number_;  // number of every cell that was visited
  std::unordered_map<std::uint64_t, std::uint32_t> corner_number_;
  std::vector<LatticePoint> corner_;
  std::vector<double> value_;
};

}  // namespace bodice::proxy
