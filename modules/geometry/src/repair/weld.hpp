#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <bodice/geometry/types.hpp>

namespace bodice::inline v0_1::geometry {

/// The diagonal that tolerances are relative to: that of the bounding box, unless strays stretch it past what
/// the middle half of the points explains.
double robust_diagonal(std::span<const Vec3> points);

/// Assigns each point, one at a time, to an earlier point within the tolerance, if there is one. Only
/// representatives attract further points, so that chains of near points do not collapse into one. Cost: O(1)
/// a point, expected.
class Welder {
 public:
  Welder(double tolerance_m, std::size_t expected);
  /// The number of the representative of `p`, a new one if none is near.
  Index add(const Vec3& p);
  /// Has the memory of a point's bucket at hand, which is added soon.
  void fetch(const Vec3& p) const;
  const std::vector<Vec3>& representatives() const { return points_; }

 private:
  struct Cell {
    std::int64_t x, y, z;
  };
  /// A point in the list of its bucket.
  struct Link {
    Index previous;      ///< the previous point of the same bucket
    std::uint32_t mark;  ///< a mark of its cell, by which points of other cells in the bucket are skipped
  };
  Cell cell_of(const Vec3& p) const;
  Index find_in(const Cell& cell, const Vec3& p) const;
  /// Puts a point at the head of its bucket.
  Link link(Index point);
  void grow();

  double tolerance_;
  double cell_size_;
  std::vector<Vec3> points_;
  std::vector<Index> head_;  // a power of two of buckets: the latest point of each
  std::vector<Link> link_;
};

}  // namespace bodice::geometry
