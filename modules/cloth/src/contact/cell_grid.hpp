// Cells of one size in a table of a power of two slots: far cells share a slot, near ones never do. Rows of
// cells lie together, so that 27 cells are nine runs of memory, gathered once for all that a cell holds.
// Based on: Matthias Teschner et al. Optimized Spatial Hashing for Collision Detection of Deformable Objects.
// 2003. Differs: rows are placed by a skewed lattice in place of a hash, so that what shares a slot is far
// away whatever way the cloth hangs; slots are filled by a counting sort in two steps, first by chapters of
// the table, which all workers share, then inside each: the order in a slot is that of the particles.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include <bodice/engine/context.hpp>
#include <bodice/engine/parallel.hpp>

#include "base/particles.hpp"

namespace bodice::cloth {

/// Points with their particles, as structure of arrays.
struct PointRun {
  const float *x = nullptr, *y = nullptr, *z = nullptr;  ///< #count each, readable up to a multiple of four
  const Index* particle = nullptr;
  std::size_t count = 0;
};

class CellGrid {
 public:
  CellGrid() = default;
  /// Empty, for this many points.
  CellGrid(float cell_m, std::size_t points);

  /// `points` are as many as were announced.
  void fill(const engine::Context& context, std::span<const Point> points);

  /// Calls visit(inside, round) for all slots with points: those in the slot, and all points of the cells in
  /// and round it, others among them, in one or more pieces of bounded size. Slots run in any order and on
  /// any worker, the pieces of one in order on the same.
  template <class Visit>
  void for_each_slot(const engine::Context& context, Visit&& visit) const {
    engine::parallel_for(context, chapter_begin_.size() - 1, 1, [&](std::size_t chapter, std::size_t) {
      Gathered round;
      for (Index k = chapter_begin_[chapter]; k < chapter_begin_[chapter + 1];) {
        const std::size_t slot = slot_[k], count = begin_[slot + 1] - k;
        const PointRun inside = {&x_[k], &y_[k], &z_[k], &particle_[k], count};
        gather_round(slot, round, [&] { visit(inside, round.run()); });
        k += static_cast<Index>(count);
      }
    });
  }

 private:
  struct Cell {
    int x, y, z;
  };
  struct Staged {
    float x, y, z;
    Index particle, slot;
  };
  // Copies of points. Writing four where fewer are wanted spares a loop.
  struct Gathered {
    static constexpr std::size_t kMost = 256;
    float x[kMost + 4], y[kMost + 4], z[kMost + 4];
    Index particle[kMost + 4];
    std::size_t count = 0;

    PointRun run() const { return {x, y, z, particle, count}; }
  };

  Cell cell_of(const Point& at) const;
  Index slot_of(const Point& at) const;
  std::size_t row_of(int y, int z) const {
    return ((static_cast<std::size_t>(y) + skew_ * static_cast<std::size_t>(z)) & row_mask_) << x_bits_;
  }
  void append(Index first, std::size_t count, Gathered& to) const;

  // Far cells that share a slot share what lies round it, too: places of slots are linear in those of cells.
  template <class Flush>
  void gather_round(std::size_t slot, Gathered& round, Flush&& flush) const {
    round.count = 0;
    auto gather = [&](std::size_t from, std::size_t cells) {
      const Index last = begin_[from + cells];
      for (Index k = begin_[from]; k < last;) {
        const std::size_t count = std::min<std::size_t>(last - k, Gathered::kMost - round.count);
        append(k, count, round);
        k += static_cast<Index>(count);
        if (round.count == Gathered::kMost) flush(), round.count = 0;
      }
    };
    const std::size_t row = slot >> x_bits_, left = (slot - 1) & x_mask_;
    const std::size_t cells = std::min<std::size_t>(3, x_mask_ + 1 - left);  // before the fold
    for (std::size_t k = 0; k < 9; ++k) {
      const std::size_t first = ((row + k % 3 - 1 + skew_ * (k / 3 - 1)) & row_mask_) << x_bits_;
      gather(first + left, cells);
      if (cells < 3) gather(first, 3 - cells);
    }
    if (round.count > 0) flush();
  }

  void begin_chapters(std::size_t blocks);
  void sort_chapter(std::size_t chapter);

  int x_bits_ = 0, chapter_shift_ = 0;
  std::size_t x_mask_ = 0, row_mask_ = 0, skew_ = 0;
  float per_cell_ = 0.0f;             // cells a meter
  std::vector<Index> begin_;          // #slots + 1
  std::vector<float> x_, y_, z_;      // #P and three more, by slot, ascending particles inside one
  std::vector<Index> particle_;       // #P and three more, in the same order; before, each point's slot
  std::vector<Index> slot_;           // #P, in the same order
  std::vector<Staged> staged_;        // #P, by chapter, ascending inside one
  std::vector<Index> chapter_next_;   // #blocks x #chapters: counts, then where the next one goes
  std::vector<Index> chapter_begin_;  // #chapters + 1
};

}  // namespace bodice::cloth
