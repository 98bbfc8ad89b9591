#include "repair/weld.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include <bodice/engine/random.hpp>

namespace bodice::inline v0_1::geometry {
namespace {

// A box this many times wider than the middle half of its points contains strays. The ratio is 2 to 4 on
// bodies, from standing to sitting.
constexpr double kStrayRatio = 16.0;
// Cell size in tolerances. In such cells most points look into one of the eight cells that may matter.
constexpr double kCellTolerances = 8.0;
// Cell numbers up to this bound are exact integers in a double. Strays beyond it share the outermost cells.
constexpr double kFarthestCell = 0x1p52;

double middle_half(std::vector<double>& values) {
  const auto low = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 4);
  const auto high = values.begin() + static_cast<std::ptrdiff_t>(values.size() - 1 - values.size() / 4);
  std::nth_element(values.begin(), low, values.end());
  std::nth_element(low, high, values.end());
  return *high - *low;
}

std::uint64_t hash_of(std::int64_t x, std::int64_t y, std::int64_t z) {
  std::uint64_t hash = 1;
  for (const std::int64_t number : {x, y, z}) hash = engine::mix64(hash ^ static_cast<std::uint64_t>(number));
  return hash;
}

std::uint32_t mark_of(std::uint64_t hash) {
  return static_cast<std::uint32_t>(hash >> 32u);
}

}  // namespace

double robust_diagonal(std::span<const Vec3> points) {
  if (points.empty()) return 0.0;
  const Box box = bounding_box(points);
  const double full = box.size().stableNorm();
  Vec3 middle;
  std::vector<double> values(points.size());
  for (int k = 0; k < 3; ++k) {
    std::transform(points.begin(), points.end(), values.begin(), [k](const Vec3& p) { return p[k]; });
    middle[k] = middle_half(values);
  }
  const double robust = kStrayRatio * middle.stableNorm();
  return robust > 0.0 ? std::min(full, robust) : full;
}

Welder::Welder(double tolerance_m, std::size_t expected)
    : tolerance_(std::max(tolerance_m, 0.0)),
      cell_size_(tolerance_ > 0.0 ? kCellTolerances * tolerance_ : 0.0),
      head_(std::bit_ceil(std::max<std::size_t>(expected, 16)), kNoIndex) {
  points_.reserve(expected);
  link_.reserve(expected);
}

Welder::Cell Welder::cell_of(const Vec3& p) const {
  auto number = [&](double x) {
    // Without a tolerance the value itself is the cell; adding 0 makes -0 and 0 one value.
    if (cell_size_ == 0.0) return std::bit_cast<std::int64_t>(x + 0.0);
    return static_cast<std::int64_t>(std::clamp(std::floor(x / cell_size_), -kFarthestCell, kFarthestCell));
  };
  return {number(p[0]), number(p[1]), number(p[2])};
}

Index Welder::find_in(const Cell& cell, const Vec3& p) const {
  const std::uint64_t hash = hash_of(cell.x, cell.y, cell.z);
  Index found = kNoIndex;
  for (Index i = head_[hash & (head_.size() - 1)]; i != kNoIndex; i = link_[i].previous)
    if (link_[i].mark == mark_of(hash) && (points_[i] - p).cwiseAbs().maxCoeff() <= tolerance_ &&
        (points_[i] - p).stableNorm() <= tolerance_)
      found = i;  // a bucket runs from the latest to the earliest point: the earliest is the last one found
  return found;
}

Welder::Link Welder::link(Index point) {
  const Cell cell = cell_of(points_[point]);
  const std::uint64_t hash = hash_of(cell.x, cell.y, cell.z);
  return {std::exchange(head_[hash & (head_.size() - 1)], point), mark_of(hash)};
}

void Welder::fetch(const Vec3& p) const {
  const Cell cell = cell_of(p);
  __builtin_prefetch(&head_[hash_of(cell.x, cell.y, cell.z) & (head_.size() - 1)]);
}

Index Welder::add(const Vec3& p) {
  const Cell low = cell_of(p - Vec3::Constant(tolerance_));
  const Cell high = cell_of(p + Vec3::Constant(tolerance_));
  Index found = kNoIndex;  // the largest index, so that std::min keeps the earliest
  for (std::int64_t x = low.x;; x = high.x) {
    for (std::int64_t y = low.y;; y = high.y) {
      for (std::int64_t z = low.z;; z = high.z) {
        found = std::min(found, find_in({x, y, z}, p));
        if (z == high.z) break;
      }
      if (y == high.y) break;
    }
    if (x == high.x) break;
  }
  if (found != kNoIndex) return found;
  if (points_.size() == head_.size()) grow();
  const auto id = static_cast<Index>(points_.size());
  points_.push_back(p);
  link_.push_back(link(id));
  return id;
}

void Welder::grow() {
  head_.assign(2 * head_.size(), kNoIndex);
  for (Index i = 0; i < points_.size(); ++i) link_[i] = link(i);
}

}  // namespace bodice::geometry
