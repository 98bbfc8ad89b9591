// The largest balls that touch a skin at a point from either side, without a search tree.
#pragma once

#include <cstddef>

namespace bodice::fitting {

/// Points and unit normals, structure of arrays.
struct TouchingPoints {
  std::size_t count = 0;
  const float *x = nullptr, *y = nullptr, *z = nullptr, *nx = nullptr, *ny = nullptr, *nz = nullptr;
};

/// A ball that touches the skin at p with its center along the unit vector n passes through q if its radius
/// is |q - p|^2 / (2 n . (q - p)): the largest one free of all q has the least of these. Points that are seen
/// at less than 6 degrees from the tangent plane are taken for p's own neighborhood. Radii never exceed
/// `most`. Writes #points radii inward (along -n) and outward. O(#points^2), vector code.
void touching_radii(const TouchingPoints& points, float most, float* inward, float* outward);

}  // namespace bodice::fitting
