// A garment that needs no file: a square of cloth above the head of the built-in body.
#pragma once

#include <bodice/tryon/wardrobe.hpp>

/// Has side x side vertices, four centimeters apart.
inline bodice::tryon::WornGarment sheet(int side) {
  bodice::tryon::WornGarment cloth{.name = "sheet"};
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j)
      cloth.mesh.positions.push_back({0.04 * (i - side / 2), 1.75, 0.04 * (j - side / 2)});
  const auto n = static_cast<bodice::geometry::Index>(side);
  for (bodice::geometry::Index i = 0; i + 1 < n; ++i)
    for (bodice::geometry::Index j = 0; j + 1 < n; ++j) {
      const bodice::geometry::Index a = i * n + j, b = a + 1, c = a + n, d = c + 1;
      cloth.mesh.triangles.push_back({a, b, c});
      cloth.mesh.triangles.push_back({b, d, c});
    }
  return cloth;
}
