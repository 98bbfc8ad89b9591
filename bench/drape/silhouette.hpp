#pragma once

#include <vector>

#include <bodice/geometry/tri_mesh.hpp>

namespace bench {

/// How far the outlines of two garments lie apart at most, metres: seen from the front and from the side,
/// left and right, in bands of 4 cm of height that both reach.
double outline_difference_m(const bodice::geometry::TriMesh& a, const bodice::geometry::TriMesh& b);

}  // namespace bench
