// From ellipsoids that follow the skin to ellipsoids that leave none of it outside.
#pragma once

#include <span>
#include <vector>

#include <bodice/engine/context.hpp>
#include <bodice/geometry/ellipsoid.hpp>
#include <bodice/geometry/mesh_distance.hpp>
#include <bodice/geometry/tri_mesh.hpp>

#include "base/interior_grid.hpp"

namespace bodice::fitting {

using geometry::Index;
using geometry::Vec3;

/// Grows `ellipsoid` about as little as holding `points` takes: the least ellipsoid around them and the
/// corners of the icosahedron inscribed in it, whose own least ellipsoid it is.
geometry::Ellipsoid grown(const geometry::Ellipsoid& ellipsoid, std::span<const Vec3> points);

/// The ellipsoid stretched toward `point` until it holds it; what it held it still holds. In its own frame,
/// where it is the unit ball and the point at distance rho: semi-axis a = (1 + rho) / 2 toward the point,
/// the others sqrt(a), so that the ball osculates the far end of the long axis from inside.
geometry::Ellipsoid stretched(const geometry::Ellipsoid& ellipsoid, const Vec3& point);

/// Grows the ellipsoids until each of the triangles lies inside a single one, and so wholly inside the union:
/// an ellipsoid is convex. Certain: what a few passes leave is covered by stretching, which lets go of
/// nothing. O(#triangles #ellipsoids).
void cover_triangles(const engine::Context& context, const geometry::TriMesh& mesh,
                     std::span<const Index> triangles, std::vector<geometry::Ellipsoid>& ellipsoids);

/// Takes back what a cover of the triangles does not need: ellipsoid by ellipsoid, the least one around its
/// anchor and the triangles that no other holds. What was held stays held. O(#triangles #ellipsoids).
void relax_cover(const engine::Context& context, const geometry::TriMesh& mesh,
                 std::span<const Index> triangles, std::span<const geometry::Ellipsoid> anchors,
                 std::vector<geometry::Ellipsoid>& ellipsoids);

/// Stretches the ellipsoids until the union holds every column of the inside along its whole length, and what
/// lies between columns down to an eighth of their spacing (unsure_between()). Returns the length of columns
/// that had to be covered, meters.
double cover_interior(const engine::Context& context, const InteriorColumns& columns,
                      const geometry::MeshDistance& distance, std::vector<geometry::Ellipsoid>& ellipsoids);

}  // namespace bodice::fitting
