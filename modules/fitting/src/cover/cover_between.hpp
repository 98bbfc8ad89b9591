// What columns of the inside cannot tell: holes that lie between them.
#pragma once

#include <span>
#include <vector>

#include <bodice/engine/context.hpp>
#include <bodice/geometry/ellipsoid.hpp>

#include "cover/column_lines.hpp"

namespace bodice::fitting {

/// Boxes, as wide as an eighth of the columns' spacing, that no ellipsoid is certain to hold although the
/// four columns around them lie inside the body. An ellipsoid is convex: one that holds a stretch of all four
/// holds all that lies between; where none does, the square is cut in four. So what is not in a box and not
/// within a column's spacing of the skin is covered for certain. `cover` is what ellipsoids, perhaps smaller
/// ones, cover of each row. Deterministic, parallel.
std::vector<geometry::Box> unsure_between(const engine::Context& context, const InteriorColumns& columns,
                                          std::span<const RowCover> cover,
                                          const std::vector<geometry::Ellipsoid>& ellipsoids);

}  // namespace bodice::fitting
