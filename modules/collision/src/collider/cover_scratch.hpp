// What Collider::cover() keeps from call to call.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <bodice/collision/collider.hpp>

#include "exact/raised_table.hpp"

namespace bodice::inline v0_1::collision {

/// The range of CoverScratch::uncovered that has the points of one owner.
struct OwnerSpan {
  std::size_t begin = 0, end = 0;
};

/// Arrays that grow with the number of points, so that a warm call allocates nothing.
struct CoverScratch {
  /// Makes room for so many points and for proxies with so many ellipsoids and texels.
  void reserve(std::size_t points, std::size_t ellipsoids, std::size_t texels);

  std::vector<geometry::Box> bounds;      ///< boxes around groups of CoverOptions::within
  std::vector<std::uint8_t> is_listed;    ///< #skin points: whether the first round has the point
  std::vector<std::uint32_t> point;       ///< the points of a round: indices in the caller's array
  std::vector<float> x, y, z;             ///< positions of the round's points, meters, local frame
  std::vector<Contact> contacts;          ///< contacts of the round's points
  std::vector<UncoveredPoint> uncovered;  ///< the round's points outside of the surface, sorted by owner
  std::vector<OwnerSpan> owners;          ///< a range of `uncovered` for each owner
  std::vector<float> rise_m;              ///< a number for each texel of all tables
};

}  // namespace bodice::collision
