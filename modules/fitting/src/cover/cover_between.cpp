#include "cover/cover_between.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include <bodice/engine/parallel.hpp>

#include "cover/column_lines.hpp"

namespace bodice::inline v0_1::fitting {
namespace {

using Stretch = InteriorColumns::Stretch;
using NearEllipsoids = std::vector<std::uint32_t>;  // indices of ellipsoids

constexpr int kSquareCuts = 3;      // squares are cut in four so many times
constexpr double kShortest = 1e-2;  // fraction of the spacing: a shorter stretch is the rounding of two ends

/// A square between four columns, or a piece of one.
struct Square {
  double x, z, size;
};

Stretch common(const Stretch& a, const Stretch& b) {
  return {std::max(a.first, b.first), std::min(a.second, b.second)};
}

/// Writes the stretches over which all four columns lie inside the body to `wanted`; `scratch` keeps its
/// memory.
void find_wanted(const InteriorColumns& columns, int i, int k, std::vector<Stretch>& wanted,
                 std::vector<Stretch>& scratch) {
  const std::span<const Stretch> first = columns.at(i, k);
  wanted.assign(first.begin(), first.end());
  for (const auto& [di, dk] : {std::pair(1, 0), std::pair(0, 1), std::pair(1, 1)}) {
    if (wanted.empty()) return;
    scratch.clear();
    for (const Stretch& a : wanted)
      for (const Stretch& b : columns.at(i + di, k + dk))
        if (const Stretch c = common(a, b); c.first < c.second) scratch.push_back(c);
    std::swap(wanted, scratch);
  }
}

/// The stretch over which the ellipsoid holds the whole square; empty (first > second) if there is none.
Stretch held_of(const Square& square, const ColumnLine& line) {
  const auto& [x, z, size] = square;
  Stretch s = line.inside(x, z);
  if (s.first < s.second) s = common(s, line.inside(x + size, z + size));
  if (s.first < s.second) s = common(s, line.inside(x + size, z));
  if (s.first < s.second) s = common(s, line.inside(x, z + size));
  return s;
}

/// Subtracts one stretch from the others; remainders up to `shortest` are dropped.
void take(const Stretch& held, double shortest, std::vector<Stretch>& left) {
  for (std::size_t n = left.size(); n-- > 0;) {
    const Stretch before{left[n].first, std::min(left[n].second, held.first)};
    const Stretch after{std::max(left[n].first, held.second), left[n].second};
    const bool has_before = before.second - before.first > shortest,
               has_after = after.second - after.first > shortest;
    if (has_before && has_after) left.push_back(after);
    if (has_before || has_after) {
      left[n] = has_before ? before : after;
    } else {
      left[n] = left.back();
      left.pop_back();
    }
  }
}

/// Subtracts the stretches over which a single ellipsoid holds all four columns.
void take_held(const std::array<std::span<const RowCover::Part>, 4>& corners, double shortest,
               std::vector<Stretch>& left) {
  std::array<std::size_t, 4> next{};
  for (const auto& [e, stretch] : corners[0]) {
    Stretch held = stretch;
    bool all = true;
    for (std::size_t c = 1; c < 4; ++c) {
      while (next[c] < corners[c].size() && corners[c][next[c]].ellipsoid < e) ++next[c];
      all = all && next[c] < corners[c].size() && corners[c][next[c]].ellipsoid == e;
      if (all) held = common(held, corners[c][next[c]].stretch);
    }
    if (all && held.first < held.second) take(held, shortest, left);
    if (left.empty()) return;
  }
}

NearEllipsoids all_of(const std::array<std::span<const RowCover::Part>, 4>& corners) {
  NearEllipsoids near;
  for (const auto& corner : corners)
    for (const RowCover::Part& part : corner) near.push_back(part.ellipsoid);
  std::sort(near.begin(), near.end());
  near.erase(std::unique(near.begin(), near.end()), near.end());
  return near;
}

/// Cuts squares in four until ellipsoids hold what is left of every piece, or the pieces are small.
class SquareCutter {
 public:
  SquareCutter(std::span<const ColumnLine> lines, double shortest, std::vector<geometry::Box>& unsure)
      : lines_(lines), shortest_(shortest), unsure_(unsure) {}

  void check(const Square& square, int cuts, const NearEllipsoids& near, std::vector<Stretch> left) {
    for (const std::uint32_t e : near) {
      const Stretch held = held_of(square, lines_[e]);
      if (held.first < held.second) take(held, shortest_, left);
      if (left.empty()) return;
    }
    if (cuts > 0) return cut(square, cuts, near, left);
    const auto& [x, z, size] = square;
    for (const auto& [low, high] : left) {
      geometry::Box box;
      box.extend(geometry::Vec3(x, low, z));
      box.extend(geometry::Vec3(x + size, high, z + size));
      unsure_.push_back(box);
    }
  }

  void cut(const Square& square, int cuts, const NearEllipsoids& near, const std::vector<Stretch>& left) {
    const double half = 0.5 * square.size;
    for (const double dz : {0.0, half})
      for (const double dx : {0.0, half}) check({square.x + dx, square.z + dz, half}, cuts - 1, near, left);
  }

 private:
  std::span<const ColumnLine> lines_;
  double shortest_;
  std::vector<geometry::Box>& unsure_;
};

}  // namespace

std::vector<geometry::Box> unsure_between(const engine::Context& context, const InteriorColumns& columns,
                                          std::span<const RowCover> cover,
                                          const std::vector<geometry::Ellipsoid>& ellipsoids) {
  const std::vector<ColumnLine> lines(ellipsoids.begin(), ellipsoids.end());
  const std::size_t rows = columns.nz > 1 ? static_cast<std::size_t>(columns.nz - 1) : 0;
  const double shortest = kShortest * columns.spacing_m;
  std::vector<std::vector<geometry::Box>> of_row(rows);
  constexpr std::size_t kGrain = 4;
  engine::parallel_for(context, rows, kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row) {
      const int k = static_cast<int>(row);
      SquareCutter cutter(lines, shortest, of_row[row]);
      std::vector<Stretch> left, scratch;
      for (int i = 0; i + 1 < columns.nx; ++i) {
        find_wanted(columns, i, k, left, scratch);
        if (left.empty()) continue;
        const std::array corners{cover[row].at(i), cover[row].at(i + 1), cover[row + 1].at(i),
                                 cover[row + 1].at(i + 1)};
        take_held(corners, shortest, left);
        if (!left.empty())
          cutter.cut({columns.x(i), columns.z(k), columns.spacing_m}, kSquareCuts, all_of(corners), left);
      }
    }
  });
  std::vector<geometry::Box> unsure;
  for (const auto& row : of_row) unsure.insert(unsure.end(), row.begin(), row.end());
  return unsure;
}

}  // namespace bodice::fitting
