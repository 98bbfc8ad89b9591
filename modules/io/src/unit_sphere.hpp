#pragma once

#include <bodice/geometry/tri_mesh.hpp>

namespace bodice::inline v0_1::io {

/// The unit sphere as an octahedron with each face split `splits` times: 8 * 4^splits triangles, wound
/// outward. Each position is its own normal.
geometry::TriMesh unit_sphere(int splits);

}  // namespace bodice::io
