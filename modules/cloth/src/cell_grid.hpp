// Cells of one size in a table of a power of two slots: far cells share a slot, near ones never do. Rows of
// cells lie together, so that 27 cells are nine runs of memory. Based on: Matthias Teschner et al. Optimized
// Spatial Hashing for Collision Detection of Deformable Objects. 2003. Differs: rows are placed by a skewed
// lattice in place of a hash, so that what shares a slot is far away whatever way the cloth hangs; slots are
// filled by a counting sort in two steps, first by chapters of the table, which all workers share, then
// inside each: the order in a slot is that of the particles.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include <bodice/engine/context.hpp>

#include "particles.hpp"

namespace bodice::cloth {

class CellGrid {
 public:
  struct Entry {
    Point at;
    Index particle, slot;
  };

  CellGrid() = default;
  /// Empty, for this many points.
  CellGrid(float cell_m, std::size_t points);

  /// `points` are as many as were announced.
  void fill(const engine::Context& context, std::span<const Point> points);

  /// Calls visit(entry) for all that lie in the 27 cells around `at`, and for some that do not.
  template <class Visit>
  void visit_near(const Point& at, Visit&& visit) const {
    const Cell c = cell_of(at);
    for (int row = 0; row < 9; ++row) {
      const std::size_t first = row_of(c.y + row % 3 - 1, c.z + row / 3 - 1);
      const std::size_t left = static_cast<std::size_t>(c.x - 1) & x_mask_;
      const std::size_t run = std::min<std::size_t>(3, x_mask_ + 1 - left);  // cells before the fold
      visit_run(first + left, run, visit);
      visit_run(first, 3 - run, visit);
    }
  }

 private:
  struct Cell {
    int x, y, z;
  };
  Cell cell_of(const Point& at) const;
  Index slot_of(const Point& at) const;
  std::size_t row_of(int y, int z) const {
    return ((static_cast<std::size_t>(y) + skew_ * static_cast<std::size_t>(z)) & row_mask_) << x_bits_;
  }
  template <class Visit>
  void visit_run(std::size_t slot, std::size_t cells, Visit& visit) const {
    for (Index k = begin_[slot]; k < begin_[slot + cells]; ++k) visit(entry_[k]);
  }

  void begin_chapters(std::size_t blocks);
  void sort_chapter(std::size_t chapter);

  int x_bits_ = 0, chapter_shift_ = 0;
  std::size_t x_mask_ = 0, row_mask_ = 0, skew_ = 0;
  float per_cell_ = 0.0f;             // cells a metre
  std::vector<Index> begin_;          // #slots + 1
  std::vector<Entry> staged_;         // #P, by chapter, ascending inside one
  std::vector<Entry> entry_;          // #P, by slot, ascending inside one; before, each point's slot
  std::vector<Index> chapter_next_;   // #blocks x #chapters: counts, then where the next entry goes
  std::vector<Index> chapter_begin_;  // #chapters + 1, into staged_ and entry_
};

}  // namespace bodice::cloth
