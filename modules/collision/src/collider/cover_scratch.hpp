// What Collider::cover() keeps from call to call.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <bodice/collision/collider.hpp>

#include "exact/raised_table.hpp"

namespace bodice::inline v0_1::collision {

/// Points of one owner: a part of CoverScratch::uncovered.
struct OwnerSpan {
  std::size_t begin = 0, end = 0;
};

/// Arrays that grow with the number of points, so that a warm call allocates nothing.
struct CoverScratch {
  /// Makes room for so many points and for proxies with so many ellipsoids and texels.
  void reserve(std::size_t points, std::size_t ellipsoids, std::size_t texels);

  std::vector<std::uint32_t> point;       ///< those of a round: indices in the caller's array
  std::vector<float> x, y, z;             ///< the same points, meters, local frame
  std::vector<Contact> contacts;          ///< of the same points
  std::vector<UncoveredPoint> uncovered;  ///< those that are outside, by owner
  std::vector<OwnerSpan> owners;          ///< of uncovered
  std::vector<float> rise_m;              ///< a number a texel of all tables
};

}  // namespace bodice::collision
