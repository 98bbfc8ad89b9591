// The strain of a triangle of cloth.
#pragma once

#include <algorithm>
#include <span>

#include <bodice/geometry/tri_mesh.hpp>

namespace bodice::inline v0_1::tryon {

/// The elongation of the most stretched edge of a triangle, zero or more. Edges of no length at rest are left
/// out.
inline double longest_strain(const geometry::TriMesh& rest, std::span<const geometry::Vec3> now,
                             const geometry::Triangle& t) {
  double strain = 0.0;
  for (int k = 0; k < 3; ++k) {
    const geometry::Index a = t[static_cast<std::size_t>(k)], b = t[static_cast<std::size_t>((k + 1) % 3)];
    const double length_m = (rest.positions[a] - rest.positions[b]).norm();
    if (length_m > 0.0) strain = std::max(strain, (now[a] - now[b]).norm() / length_m - 1.0);
  }
  return strain;
}

}  // namespace bodice::tryon
