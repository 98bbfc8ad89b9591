// Judges one frame of a body that moves against its true skin: the proxy's error, and skin that shows
// through cloth.
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

/// Distances of a collider beside the exact signed distance to the skin it stands for.
struct ProxyError {
  fitting::Spread error_m;    ///< of the distance, meters
  double missed_share = 0.0;  ///< points more than 1 mm inside the skin that the proxy has outside
  double false_share = 0.0;   ///< points more than 1 mm outside the skin that the proxy has inside
  std::size_t samples = 0;
};

/// Measures a collider at 4,000 points within `within_m` of the skin, spread evenly over its area and its two
/// sides. Points where the skin overlaps itself, and points with nearest skin under another layer of the
/// body, have no meaningful distance and are left out. `distance` is of `skin`, both in the pose of the
/// collider. Deterministic for any number of workers. Cost: a signed distance, two winding numbers and a
/// query a point.
ProxyError measure_proxy_error(const engine::Context& context, const collision::Collider& collider,
                               const geometry::TriMesh& skin, const geometry::MeshDistance& distance,
                               double within_m);

/// Whether a point lies in skin that overlaps itself, or `nearest`, its closest skin, lies under another
/// layer of the body. Skin that is buried bounds nothing, so that the distance to it is none of the body.
/// Cost: a winding number.
bool is_overlapped(const geometry::MeshDistance& distance, const geometry::Vec3& point,
                   const geometry::SurfacePoint& nearest);

/// A sample of a cloth triangle inside the skin.
struct InsidePoint {
  geometry::Vec3 at;
  double area_m2 = 0.0;        ///< of the cloth that it stands for
  double depth_m = 0.0;        ///< distance to the nearest skin
  bool is_overlapped = false;  ///< it lies in skin that overlaps itself, or its nearest skin is buried there
};

/// Calls visit for each sample of a triangle, 4 mm apart, that lies deeper than `depth_m` in the skin. `walk`
/// is of `skin`; one that was at a triangle nearby costs less than a new one. Cost: a signed distance a
/// sample that may be so deep by the distance of the one before.
void for_each_inside(const geometry::MeshDistance& skin, geometry::DistanceWalk& walk,
                     std::span<const geometry::Vec3> positions, const geometry::Triangle& triangle,
                     double depth_m, const std::function<void(const InsidePoint&)>& visit);

/// Areas of cloth inside the skin.
struct ClothInside {
  double shown_m2 = 0.0;  ///< what a viewer sees as spots of skin
  /// The area of cloth in skin that overlaps itself, as where a clip presses an arm into the flank. No
  /// position of the cloth is right there, and little of it is visible.
  double overlapped_m2 = 0.0;
};

/// Area of the cloth that lies more than `depth_m` inside the skin. Triangles are sampled every 4 mm. The
/// result does not depend on the number of workers.
ClothInside cloth_inside(const engine::Context& context, const geometry::MeshDistance& skin,
                         std::span<const geometry::Vec3> positions,
                         std::span<const geometry::Triangle> triangles, double depth_m);

}  // namespace bodice::tryon
