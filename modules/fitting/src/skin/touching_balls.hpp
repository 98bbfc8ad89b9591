// The largest balls that touch a skin at a point from either side, found without a search tree.
#pragma once

#include <cstddef>

namespace bodice::inline v0_1::fitting {

/// Points and unit normals, structure of arrays.
struct TouchingPoints {
  std::size_t count = 0;
  const float *x = nullptr, *y = nullptr, *z = nullptr, *nx = nullptr, *ny = nullptr, *nz = nullptr;
};

/// Writes #points radii inward (along -n) and outward. A ball that touches the skin at p, with its center
/// along the unit vector n, passes through q if its radius is |q - p|^2 / (2 n . (q - p)); the least of these
/// over all q is the radius of the largest empty ball. Points less than 6 degrees off the tangent plane count
/// as p's own neighborhood. No radius exceeds `most`. O(#points^2), in vector code.
void touching_radii(const TouchingPoints& points, float most, float* inward, float* outward);

}  // namespace bodice::fitting
