// Cells of one size, folded into a box of a power of two cells a side: far cells share a slot, near ones
// never do. Rows of cells lie together, so that 27 cells are nine runs of memory. Based on: Matthias Teschner
// et al. Optimized Spatial Hashing for Collision Detection of Deformable Objects. 2003. Differs: coordinates
// are masked in place of hashed; slots are filled by a counting sort, so that their order is that of the
// particles.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "particles.hpp"

namespace bodice::cloth {

class CellGrid {
 public:
  struct Entry {
    Point at;
    Index particle;
  };

  CellGrid() = default;
  CellGrid(std::array<int, 3> bits, float cell_m, std::size_t points);

  void fill(std::span<const Point> points);

  /// Calls visit(entry) for all that lie in the 27 cells around `at`, and for some that do not.
  template <class Visit>
  void visit_near(const Point& at, Visit&& visit) const {
    const Cell c = cell_of(at);
    for (int row = 0; row < 9; ++row) {
      const std::size_t first = row_of(c.y + row % 3 - 1, c.z + row / 3 - 1);
      const std::size_t left = static_cast<std::size_t>(c.x - 1) & mask_[0];
      const std::size_t run = std::min<std::size_t>(3, mask_[0] + 1 - left);  // cells before the fold
      visit_run(first + left, run, visit);
      visit_run(first, 3 - run, visit);
    }
  }

 private:
  struct Cell {
    int x, y, z;
  };
  Cell cell_of(const Point& at) const;
  std::size_t row_of(int y, int z) const {
    return ((static_cast<std::size_t>(y) & mask_[1]) | (static_cast<std::size_t>(z) & mask_[2]) << bits_[1])
           << bits_[0];
  }
  template <class Visit>
  void visit_run(std::size_t slot, std::size_t cells, Visit& visit) const {
    for (Index k = begin_[slot]; k < begin_[slot + cells]; ++k) visit(entry_[k]);
  }

  std::array<int, 3> bits_ = {};
  std::array<std::size_t, 3> mask_ = {};
  float per_cell_ = 0.0f;       // cells a metre
  std::vector<Index> begin_;    // #slots + 1
  std::vector<Index> slot_of_;  // #P
  std::vector<Entry> entry_;    // #P, by slot, ascending inside one
};

/// A grid for as many points as these, as wide as they lie; not filled.
CellGrid make_cell_grid(std::span<const Point> points, float cell_m);

}  // namespace bodice::cloth
