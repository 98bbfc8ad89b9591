// Measures one frame of a moving body against its true skin: the proxy's error, and cloth inside the skin.
#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include <bodice/collision/collider.hpp>
#include <bodice/engine/context.hpp>
#include <bodice/fitting/fit.hpp>
#include <bodice/geometry/distance_walk.hpp>
#include <bodice/geometry/mesh_distance.hpp>
#include <bodice/geometry/tri_mesh.hpp>

namespace bodice::inline v0_1::tryon {

/// The difference between a collider's distances and the exact signed distances to its skin.
struct ProxyError {
  fitting::Spread error_m;    ///< absolute error of the distance, meters
  double missed_share = 0.0;  ///< share of points more than 1 mm inside the skin and outside of the proxy
  double false_share = 0.0;   ///< share of points more than 1 mm outside of the skin and inside the proxy
  std::size_t samples = 0;
};

/// Measures a collider at 4,000 points within `within_m` of the skin, spread evenly over its area and its two
/// sides. Points inside skin that overlaps itself, and points with closest skin that is buried in the body,
/// have no meaningful distance and are left out. `distance` is of `skin`, both in the pose of the collider.
/// Deterministic for any number of workers. Cost: a signed distance, two winding numbers and a query a point.
ProxyError measure_proxy_error(const engine::Context& context, const collision::Collider& collider,
                               const geometry::TriMesh& skin, const geometry::MeshDistance& distance,
                               double within_m);

/// Whether a point lies in skin that overlaps itself, or its closest point `nearest` is buried inside the
/// body. Buried skin does not bound the body, so that the distance to it means nothing. Cost: a winding
/// number, and an inside test.
bool is_overlapped(const geometry::MeshDistance& distance, const geometry::Vec3& point,
                   const geometry::SurfacePoint& nearest);

/// A sample of a cloth triangle inside the skin.
struct InsidePoint {
  geometry::Vec3 at;
  double area_m2 = 0.0;        ///< area of the cloth that the sample represents
  double depth_m = 0.0;        ///< distance to the nearest skin
  bool is_overlapped = false;  ///< whether is_overlapped() holds for it
};

/// Calls visit for each sample of a triangle, 4 mm apart, that is deeper than `depth_m` inside the skin.
/// `walk` is a walk on `skin`; one that was at a neighboring triangle costs less than a new one. Cost: a
/// signed distance for each sample that may be so deep, by the distance of the sample before.
void for_each_inside(const geometry::MeshDistance& skin, geometry::DistanceWalk& walk,
                     std::span<const geometry::Vec3> positions, const geometry::Triangle& triangle,
                     double depth_m, const std::function<void(const InsidePoint&)>& visit);

/// Areas of cloth inside the skin.
struct ClothInside {
  double shown_m2 = 0.0;  ///< area that shows as spots of skin
  /// The area of cloth inside skin that overlaps itself, for instance where a clip moves an arm into the
  /// flank. No position of the cloth would be right there, and little of it is visible.
  double overlapped_m2 = 0.0;
};

/// Area of the cloth that lies more than `depth_m` inside the skin. Triangles are sampled every 4 mm. The
/// result does not depend on the number of workers.
ClothInside cloth_inside(const engine::Context& context, const geometry::MeshDistance& skin,
                         std::span<const geometry::Vec3> positions,
                         std::span<const geometry::Triangle> triangles, double depth_m);

}  // namespace bodice::tryon
