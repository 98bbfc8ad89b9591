// Cells of one size in a table of a power of two slots: far cells share a slot, near ones never do. Rows of
// cells lie together, so that 27 cells are nine runs of memory. Based on: Matthias Teschner et al. Optimized
// Spatial Hashing for Collision Detection of Deformable Objects. 2003. Differs: rows are placed by a skewed
// lattice in place of a hash, so that what shares a slot is far away whatever way the cloth hangs; slots are
// filled by a counting sort in two steps, first by chapters of the table, which all workers share, then
// inside each: the order in a slot is that of the particles.
#pragma once

#include <algorithm>
#include <bit>
#include <span>
#include <vector>

#include <bodice/engine/context.hpp>

#include "particles.hpp"

namespace bodice::cloth {

class CellGrid {
 public:
  CellGrid() = default;
  /// Empty, for this many points.
  CellGrid(float cell_m, std::size_t points);

  /// `points` are as many as were announced.
  void fill(const engine::Context& context, std::span<const Point> points);

  /// Calls visit(particle) for all points within sqrt(reach2_m2) of `at`, which is at most a cell's size.
  template <class Visit>
  void visit_within(const Point& at, float reach2_m2, Visit&& visit) const {
    const Cell c = cell_of(at);
    const std::size_t left = static_cast<std::size_t>(c.x - 1) & x_mask_;
    const std::size_t run = std::min<std::size_t>(3, x_mask_ + 1 - left);  // cells before the fold
    for (int row = 0; row < 9; ++row) {
      const std::size_t first = row_of(c.y + row % 3 - 1, c.z + row / 3 - 1);
      visit_run(first + left, run, at, reach2_m2, visit);
      if (run < 3) visit_run(first, 3 - run, at, reach2_m2, visit);
    }
  }

 private:
  struct Cell {
    int x, y, z;
  };
  struct Staged {
    float x, y, z;
    Index particle, slot;
  };
  Cell cell_of(const Point& at) const;
  Index slot_of(const Point& at) const;
  std::size_t row_of(int y, int z) const {
    return ((static_cast<std::size_t>(y) + skew_ * static_cast<std::size_t>(z)) & row_mask_) << x_bits_;
  }
  template <class Visit>
  void visit_run(std::size_t slot, std::size_t cells, const Point& at, float reach2_m2, Visit& visit) const {
    const Index last = begin_[slot + cells];
    for (Index k = begin_[slot]; k < last; k += 4) {
      const Float4 dx = load(&x_[k]) - at.x, dy = load(&y_[k]) - at.y, dz = load(&z_[k]) - at.z;
      unsigned within = lanes(dx * dx + dy * dy + dz * dz <= splat(reach2_m2));
      if (last - k < 4) within &= (1u << (last - k)) - 1;
      for (; within != 0; within &= within - 1)
        visit(particle_[k + static_cast<Index>(std::countr_zero(within))]);
    }
  }

  void begin_chapters(std::size_t blocks);
  void sort_chapter(std::size_t chapter);

  int x_bits_ = 0, chapter_shift_ = 0;
  std::size_t x_mask_ = 0, row_mask_ = 0, skew_ = 0;
  float per_cell_ = 0.0f;             // cells a metre
  std::vector<Index> begin_;          // #slots + 1
  std::vector<float> x_, y_, z_;      // #P and three more, by slot, ascending particles inside one
  std::vector<Index> particle_;       // #P, in the same order; before, each point's slot
  std::vector<Staged> staged_;        // #P, by chapter, ascending inside one
  std::vector<Index> chapter_next_;   // #blocks x #chapters: counts, then where the next one goes
  std::vector<Index> chapter_begin_;  // #chapters + 1
};

}  // namespace bodice::cloth
