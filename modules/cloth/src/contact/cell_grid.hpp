// Cells of one size in a table with a power of two of slots. Far cells share a slot, near cells never do. The
// cells of a row are contiguous, so that the 27 cells around a cell are nine runs of memory, gathered once
// for all points of the cell. Based on: Matthias Teschner, Bruno Heidelberger, Matthias Mueller, Danat
// Pomeranets, Markus Gross. Optimized Spatial Hashing for Collision Detection of Deformable Objects. 2003.
// Differs: a skewed lattice replaces the hash of rows, so that cells of the same slot are far apart in every
// direction. Slots are filled by a counting sort in two steps: by chapters of the table, which all workers
// share, then within each chapter. The order within a slot is that of the particles.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include <bodice/engine/context.hpp>
#include <bodice/engine/parallel.hpp>

#include "base/particles.hpp"

namespace bodice::cloth {

/// Points with their particles, structure of arrays.
struct PointRun {
  const float *x = nullptr, *y = nullptr, *z = nullptr;  ///< #count; readable up to the next multiple of four
  const Index* particle = nullptr;
  std::size_t count = 0;
};

/// Finds points that are near each other.
class CellGrid {
 public:
  CellGrid() = default;
  /// An empty grid for `points` points.
  CellGrid(float cell_m, std::size_t points);

  /// Fills the grid; the number of points is that of the constructor.
  void fill(const engine::Context& context, std::span<const Point> points);

  /// Calls visit(inside, round) for every slot with points: `inside` has the points of the slot, `round`
  /// those of the cells in and around it (and of other cells that share these slots), in one or more pieces
  /// of bounded size. Slots are visited in any order by any worker; the pieces of one slot in order by the
  /// same worker.
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
  // Copies of points. There is room beyond the end, because four are written at a time.
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

  // Cells that share a slot also share the slots around it, because the slot is linear in the cell.
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
    const std::size_t cells =
        std::min<std::size_t>(3, x_mask_ + 1 - left);  // up to where the row wraps around
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
  float per_cell_ = 0.0f;            // cells a meter
  std::vector<Index> begin_;         // #slots + 1: where the points of each slot begin
  std::vector<float> x_, y_, z_;     // #P and three more: by slot, then by particle
  std::vector<Index> particle_;      // #P and three more, in the same order; during fill(), each point's slot
  std::vector<Index> slot_;          // #P, in the same order
  std::vector<Staged> staged_;       // #P: by chapter, then by particle
  std::vector<Index> chapter_next_;  // #blocks x #chapters: counts, then the offset of the next entry
  std::vector<Index> chapter_begin_;  // #chapters + 1
};

}  // namespace bodice::cloth
