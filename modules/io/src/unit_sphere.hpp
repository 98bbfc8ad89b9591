#pragma once

#include <bodice/geometry/tri_mesh.hpp>

namespace bodice::io {

/// The unit sphere as an octahedron whose faces are split `splits` times: 4^splits * 8 triangles, wound
/// outward. Each position is its own normal.
geometry::TriMesh unit_sphere(int splits);

}  // namespace bodice::io
