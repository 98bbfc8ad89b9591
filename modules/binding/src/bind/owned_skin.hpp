// Which skin each ellipsoid stands for.
#pragma once

#include <span>
#include <vector>

#include <bodice/binding/bind.hpp>

namespace bodice::inline v0_1::binding {

/// A vertex that an ellipsoid stands for, and how much it counts: its area times (1 - excess / band)^2.
struct OwnedVertex {
  std::uint32_t vertex = 0;
  double weight = 0.0;
};

/// #E: the vertices within `band_m` of having the ellipsoid as their nearest one. Of large meshes every n-th
/// vertex is taken. An ellipsoid without any gets the vertex nearest to its center. Deterministic, parallel.
std::vector<std::vector<OwnedVertex>> owned_skin(const engine::Context& context,
                                                 std::span<const proxy::ProxyEllipsoid> ellipsoids,
                                                 const geometry::TriMesh& skin, double band_m);

/// The least signed distance of a point to the ellipsoids.
double nearest_distance(std::span<const proxy::ProxyEllipsoid> ellipsoids, const Vec3& point);

}  // namespace bodice::binding
