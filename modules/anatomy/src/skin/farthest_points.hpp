// Vertices far from each other: where ends of the body may be.
#pragma once

#include "skin/skin.hpp"

namespace bodice::inline v0_1::anatomy {

/// Vertices in the order in which they were taken, with their distance fields.
struct FarthestPoints {
  std::vector<geometry::Index> vertex;
  /// Distance of every vertex from each, meters. Empty for the last of as many as were requested: the fields
  /// of the others hold its distances from them.
  std::vector<geodesic::Field> field;
};

/// Each the farthest from all before it, at most `count`: fewer where nothing farther is left. The first lies
/// farthest from the middle of the body. The same for any worker count; two workers take little more than
/// half the time of one. O(count #links).
FarthestPoints farthest_points(const engine::Context& context, const Skin& skin, std::size_t count);

}  // namespace bodice::anatomy
