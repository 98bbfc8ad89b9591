// Growing ellipsoids that follow the skin until none of the skin is outside.
#pragma once

#include <span>
#include <vector>

#include <bodice/engine/context.hpp>
#include <bodice/geometry/ellipsoid.hpp>
#include <bodice/geometry/mesh_distance.hpp>
#include <bodice/geometry/tri_mesh.hpp>

#include "base/interior_grid.hpp"

namespace bodice::inline v0_1::fitting {

using geometry::Index;
using geometry::Vec3;

/// Grows `ellipsoid` about as little as it takes to hold `points`. The result is the least ellipsoid around
/// the points and the corners of an icosahedron inscribed in `ellipsoid`; around the corners alone it would
/// be `ellipsoid`.
geometry::Ellipsoid grown(const geometry::Ellipsoid& ellipsoid, std::span<const Vec3> points);

/// The ellipsoid stretched toward `point` until it holds the point; it still holds all that it held. In the
/// frame where it is the unit ball and the point lies at distance rho, the semi-axis toward the point becomes
/// a = (1 + rho) / 2 and the others sqrt(a), so that the ball osculates the far end of the long axis from
/// inside.
geometry::Ellipsoid stretched(const geometry::Ellipsoid& ellipsoid, const Vec3& point);

/// Grows the ellipsoids until one of them holds all three corners of each triangle, and so, by convexity, the
/// whole triangle. This always succeeds: after a few passes of growing, stretching covers the rest and
/// uncovers nothing. O(#triangles #ellipsoids).
void cover_triangles(const engine::Context& context, const geometry::TriMesh& mesh,
                     std::span<const Index> triangles, std::vector<geometry::Ellipsoid>& ellipsoids);

/// Shrinks the ellipsoids of a cover where it can: one after the other becomes the least one around its
/// anchor and the triangles that no other ellipsoid holds. Held triangles stay held. O(#triangles
/// #ellipsoids).
void relax_cover(const engine::Context& context, const geometry::TriMesh& mesh,
                 std::span<const Index> triangles, std::span<const geometry::Ellipsoid> anchors,
                 std::vector<geometry::Ellipsoid>& ellipsoids);

/// Stretches the ellipsoids until the union holds every column of the interior along its whole length, and
/// what lies between the columns, down to an eighth of their spacing (unsure_between()). Returns the total
/// length of columns that no ellipsoid covered before, meters.
double cover_interior(const engine::Context& context, const InteriorColumns& columns,
                      const geometry::MeshDistance& distance, std::vector<geometry::Ellipsoid>& ellipsoids);

}  // namespace bodice::fitting
