#pragma once

#include <span>
#include <vector>

#include <bodice/geometry/types.hpp>

namespace bodice::geometry {

/// The diagonal that tolerances are measured by: of the bounding box, unless strays stretch it past what the
/// middle half of the points explains.
double robust_diagonal(std::span<const Vec3> points);

/// Takes points one at a time and says which earlier one, if any, lies within the tolerance. The first
/// comer of a place stands for it, so chains of near points do not collapse into one. Expected O(1) a point.
class Welder {
 public:
  Welder(double tolerance_m, std::size_t expected);
  /// The number of the representative of `p`, which is a new one if none was near.
  Index add(const Vec3& p);
  const std::vector<Vec3>& representatives() const { return points_; }

 private:
  struct Cell {
    std::int64_t x, y, z;
  };
  Cell cell_of(const Vec3& p) const;
  std::size_t bucket_of(const Cell& cell) const;
  Index find_in(const Cell& cell, const Vec3& p) const;
  void grow();

  double tolerance_;
  double cell_size_;
  std::vector<Vec3> points_;
  std::vector<Index> head_;  // a power of two buckets: the latest point in each
  std::vector<Index> next_;  // the one before it in the same bucket
};

}  // namespace bodice::geometry
