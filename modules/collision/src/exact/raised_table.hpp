// A relief table that rises where points of the skin are outside of the surface.
#pragma once

#include <cstdint>
#include <span>

#include "exact/union_field.hpp"
#include "model/relief_tables.hpp"

namespace bodice::inline v0_1::collision {

/// A point of the skin outside of the surface.
struct UncoveredPoint {
  std::uint32_t owner = 0;  ///< internal index of its ellipsoid
  std::uint32_t point = 0;  ///< in the caller's array
  float rise_m = 0.0f;      ///< how much higher the table has to be there
  float at[3] = {};         ///< meters, local frame
};

/// Raises the owner's table around points that all have the same owner, and bounds it anew. A point between
/// four texels with weights w_i needs the rise w_i / sum_j w_j^2 of each, times its own: the least change
/// that reaches it. A texel rises by the most that a point needs of it. `rise_m` is room for a number a
/// texel. Source of the least change: Stefan Kaczmarz. Angenaeherte Aufloesung von Systemen linearer
/// Gleichungen. 1937.
void raise_table(const UnionField& field, std::span<const UncoveredPoint> points, ReliefTables& relief,
                 std::span<float> rise_m);

}  // namespace bodice::collision
