// Normals of a rough surface.
#pragma once

#include <vector>

#include <bodice/engine/context.hpp>
#include <bodice/geometry/tri_mesh.hpp>

#include "repair/rings.hpp"

namespace bodice::inline v0_1::geometry {

/// #V: normals of vertices averaged over two rings of neighbors. Zero where a vertex has no triangles.
std::vector<Vec3> smooth_normals(const engine::Context& context, const Neighbors& neighbors,
                                 std::vector<Vec3> normals);

}  // namespace bodice::geometry
