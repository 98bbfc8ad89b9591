#pragma once

#include <vector>

#include <bodice/geometry/tri_mesh.hpp>

namespace bench {

/// How far the filled outline of either garment reaches beyond the other's at most, meters, seen from the
/// front and from the side; outlines are rows of a centimeter.
double outline_difference_m(const bodice::geometry::TriMesh& a, const bodice::geometry::TriMesh& b);

}  // namespace bench
