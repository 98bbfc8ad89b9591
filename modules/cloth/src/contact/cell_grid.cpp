#include "contact/cell_grid.hpp"

#include <algorithm>
#include <bit>
#include <utility>

#include <bodice/engine/parallel.hpp>

#include "base/tolerances.hpp"

namespace bodice::cloth {
namespace {

constexpr int kFewestBits =
    12;  // at least 16 cells a row and 256 rows, so that near cells have slots of their own
constexpr int kSlotsAParticle =
    1;  // more slots would leave the caches, which costs more than points of far cells
constexpr double kGolden = 0.381966;   // skew of the lattice, in rows, with the longest shortest vector
constexpr float kFarthestCell = 1e8f;  // beyond this cell, integers would overflow

constexpr int kChapterBits =
    7;  // chapters of the table: several for each worker, and few enough to count fast
constexpr std::size_t kChapters = std::size_t{1} << kChapterBits;
constexpr std::size_t kBlocks = 32;  // blocks of points; each counts the chapters on its own

std::size_t block_grain(std::size_t points) {
  return std::max(kParticleGrain, points / kBlocks + 1);
}

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
  chapter_shift_ = bits - kChapterBits;
  begin_.assign((std::size_t{1} << bits) + 1, 0);
  staged_.resize(points), particle_.resize(points + 3), slot_.resize(points);
  for (auto* a : {&x_, &y_, &z_}) a->assign(points + 3, 0.0f);
  chapter_next_.assign(kBlocks * kChapters, 0), chapter_begin_.assign(kChapters + 1, 0);
}

CellGrid::Cell CellGrid::cell_of(const Point& at) const {
  auto cell = [&](float value) {
    const float at_cell = std::clamp(value * per_cell_, -kFarthestCell, kFarthestCell);
    const int whole = static_cast<int>(at_cell);  // rounded toward zero; std::floor would be a function call
    return whole - (static_cast<float>(whole) > at_cell ? 1 : 0);
  };
  return {cell(at.x), cell(at.y), cell(at.z)};
}

Index CellGrid::slot_of(const Point& at) const {
  const Cell c = cell_of(at);
  return static_cast<Index>(row_of(c.y, c.z) + (static_cast<std::size_t>(c.x) & x_mask_));
}

void CellGrid::fill(const engine::Context& context, std::span<const Point> points) {
  const std::size_t grain = block_grain(points.size());
  engine::parallel_for(context, points.size(), grain, [&](std::size_t begin, std::size_t end) {
    Index* const count = &chapter_next_[begin / grain * kChapters];
    std::fill_n(count, kChapters, 0);
    for (std::size_t i = begin; i < end; ++i) {
      particle_[i] = slot_of(points[i]);
      ++count[particle_[i] >> chapter_shift_];
    }
  });
  begin_chapters(engine::block_count(points.size(), grain));
  engine::parallel_for(context, points.size(), grain, [&](std::size_t begin, std::size_t end) {
    Index* const next = &chapter_next_[begin / grain * kChapters];
    for (std::size_t i = begin; i < end; ++i) {
      const Index slot = particle_[i];
      const Point& at = points[i];
      staged_[next[slot >> chapter_shift_]++] = {at.x, at.y, at.z, static_cast<Index>(i), slot};
    }
  });
  engine::parallel_for(context, kChapters, 1,
                       [&](std::size_t chapter, std::size_t) { sort_chapter(chapter); });
  begin_.back() = static_cast<Index>(points.size());
}

// Turns counts into offsets: chapter by chapter, and in each block by block, so that entries stay ascending.
void CellGrid::begin_chapters(std::size_t blocks) {
  Index offset = 0;
  for (std::size_t c = 0; c < kChapters; ++c) {
    chapter_begin_[c] = offset;
    for (std::size_t b = 0; b < blocks; ++b)
      offset += std::exchange(chapter_next_[b * kChapters + c], offset);
  }
  chapter_begin_[kChapters] = offset;
}

// Sorts the chapter's points by slot, by counting.
void CellGrid::sort_chapter(std::size_t chapter) {
  const Index first = chapter_begin_[chapter], last = chapter_begin_[chapter + 1];
  const std::size_t slots = std::size_t{1} << chapter_shift_;
  Index* const ends = &begin_[chapter * slots];
  std::fill_n(ends, slots, 0);
  for (Index k = first; k < last; ++k) ++begin_[staged_[k].slot];
  for (Index offset = first; Index & end : std::span(ends, slots)) end = offset += end;
  for (Index k = last; k-- > first;) {
    const Staged& from = staged_[k];
    const Index to = --begin_[from.slot];
    x_[to] = from.x, y_[to] = from.y, z_[to] = from.z, particle_[to] = from.particle, slot_[to] = from.slot;
  }
}

void CellGrid::append(Index first, std::size_t count, Gathered& to) const {
  for (std::size_t k = 0; k < count; k += 4) {
    const std::size_t from = first + k, at = to.count + k;
    store(&to.x[at], load(&x_[from])), store(&to.y[at], load(&y_[from])), store(&to.z[at], load(&z_[from]));
    std::copy_n(&particle_[from], 4, &to.particle[at]);
  }
  to.count += count;
}

}  // namespace bodice::cloth
