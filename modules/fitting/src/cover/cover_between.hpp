// Holes that lie between the columns of the interior.
#pragma once

#include <span>
#include <vector>

#include <bodice/engine/context.hpp>
#include <bodice/geometry/ellipsoid.hpp>

#include "cover/column_lines.hpp"

namespace bodice::inline v0_1::fitting {

/// Boxes, an eighth of the columns' spacing wide, that no ellipsoid is certain to hold although the four
/// columns around them lie inside the body. By convexity, an ellipsoid that holds a stretch of all four
/// columns holds all that lies between; where none does, the square between the columns is cut in four. So
/// any point outside the boxes and farther than a column's spacing from the skin is covered for certain.
/// `cover` has what these ellipsoids, or smaller ones, cover of each row. Deterministic, parallel.
std::vector<geometry::Box> unsure_between(const engine::Context& context, const InteriorColumns& columns,
                                          std::span<const RowCover> cover,
                                          const std::vector<geometry::Ellipsoid>& ellipsoids);

}  // namespace bodice::fitting
