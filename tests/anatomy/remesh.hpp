// The same surface with other vertices.
#pragma once

#include <bodice/geometry/tri_mesh.hpp>

namespace remesh {

/// Every triangle becomes four; no vertex moves, so the surface is the same.
bodice::geometry::TriMesh refined(const bodice::geometry::TriMesh& mesh);

/// Collapses the shortest edges until at most `vertices` are left, never a collapse that would fold the
/// surface or join parts that do not touch.
bodice::geometry::TriMesh decimated(const bodice::geometry::TriMesh& mesh, std::size_t vertices);

}  // namespace remesh
