#include "surface/crossed_cells.hpp"

#include <cmath>

#include <bodice/engine/parallel.hpp>

namespace bodice::inline v0_1::proxy {
namespace {

constexpr std::size_t kMostCells = std::size_t{1} << 23;
constexpr std::size_t kCellGrain = 64;
constexpr std::uint32_t kNotCrossed = ~std::uint32_t{0};

std::uint64_t key_of(const LatticePoint& p) {
  constexpr std::int64_t kMiddle = std::int64_t{1} << 20;
  std::uint64_t key = 0;
  for (const int i : p) key = key << 21 | static_cast<std::uint64_t>(i + kMiddle);
  return key;
}

LatticePoint corner_of(const LatticePoint& at, int corner) {
  return {at[0] + (corner & 1), at[1] + (corner >> 1 & 1), at[2] + (corner >> 2)};
}

}  // namespace

Vec3 CrossedCells::position(const LatticePoint& at, int corner) const {
  const LatticePoint p = corner_of(at, corner);
  return origin_ + cell_m_ * Vec3(p[0], p[1], p[2]);
}

std::uint32_t CrossedCells::index_of(const LatticePoint& at) const {
  return cell_number_.at(key_of(at));
}

void CrossedCells::add(const LatticePoint& at, std::vector<LatticePoint>& next) {
  if (cell_number_.emplace(key_of(at), kNotCrossed).second) next.push_back(at);
}

std::vector<Cell> CrossedCells::numbered(const std::vector<LatticePoint>& points) {
  std::vector<Cell> cells;
  cells.reserve(points.size());
  for (const LatticePoint& at : points) {
    Cell cell{at, {}};
    for (int k = 0; k < 8; ++k) {
      const LatticePoint p = corner_of(at, k);
      const auto [found, fresh] =
          corner_number_.emplace(key_of(p), static_cast<std::uint32_t>(corner_.size()));
      if (fresh) corner_.push_back(p);
      cell.corner[static_cast<std::size_t>(k)] = found->second;
    }
    cells.push_back(cell);
  }
  return cells;
}

void CrossedCells::evaluate(const engine::Context& context,
                            const std::function<double(const Vec3&)>& distance) {
  const std::size_t first = value_.size();
  value_.resize(corner_.size());
  engine::parallel_for(context, corner_.size() - first, kCellGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = first + begin; i < first + end; ++i) value_[i] = distance(position(corner_[i]));
  });
}

/// Appends the neighbors behind faces with both signs.
void CrossedCells::add_beyond(const Cell& cell, std::vector<LatticePoint>& next) {
  for (int axis = 0; axis < 3; ++axis)
    for (const int side : {0, 1}) {
      int inside = 0;
      for (int k = 0; k < 8; ++k) inside += (k >> axis & 1) == side && value(cell, k) < 0.0;
      if (inside == 0 || inside == 4) continue;
      LatticePoint beyond = cell.at;
      beyond[static_cast<std::size_t>(axis)] += side ? 1 : -1;
      add(beyond, next);
    }
}

bool CrossedCells::find(const engine::Context& context, const std::vector<Vec3>& seeds,
                        const std::function<double(const Vec3&)>& distance) {
  std::vector<LatticePoint> wave, next;
  for (const Vec3& seed : seeds) {
    const Vec3 at = ((seed - origin_) / cell_m_).array().floor();
    if (!(at.cwiseAbs().maxCoeff() < kMostCellsAcross)) continue;
    add({static_cast<int>(at.x()), static_cast<int>(at.y()), static_cast<int>(at.z())}, wave);
  }
  for (; !wave.empty(); wave.swap(next), next.clear()) {
    if (cell_number_.size() > kMostCells) return false;
    const std::vector<Cell> looked_at = numbered(wave);
    evaluate(context, distance);
    for (const Cell& cell : looked_at) {
      int inside = 0;
      for (int k = 0; k < 8; ++k) inside += value(cell, k) < 0.0;
      if (inside == 0 || inside == 8) continue;
      cell_number_[key_of(cell.at)] = static_cast<std::uint32_t>(cells_.size());
      cells_.push_back(cell);
      add_beyond(cell, next);
    }
  }
  return true;
}

}  // namespace bodice::proxy
