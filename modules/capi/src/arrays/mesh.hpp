// Meshes in memory of the host.
#pragma once

#include <bodice/geometry/tri_mesh.hpp>

#include "base/outcome.hpp"

namespace bodice::inline v0_1::capi {

/// Copies a mesh; names the vertex or the triangle at fault. O(#V + #F).
Outcome read_mesh(const bodice_mesh* given, geometry::TriMesh& out);

}  // namespace bodice::capi
