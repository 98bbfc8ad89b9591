// Spheres, capsules and tapered capsules: what physics engines collide with.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include <bodice/body/part.hpp>
#include <bodice/geometry/types.hpp>
#include <bodice/proxy/body_proxy.hpp>

namespace bodice::inline v0_1::colliders {

using geometry::Mat3;
using geometry::Vec3;

/// The kinds of plain shapes. Each is a special case of the next.
enum class ShapeKind : std::uint8_t { kSphere, kCapsule, kTaperedCapsule };

/// The kind's name in options: "spheres", "capsules" or "tapered".
std::string_view name(ShapeKind kind);
/// The kind of a name, if there is one.
std::optional<ShapeKind> shape_kind_from_name(std::string_view text);

/// The convex hull of two balls, in meters with y up at rest. A capsule has equal radii, a sphere equal
/// centers.
struct PlainShape {
  Vec3 a = Vec3::Zero(), b = Vec3::Zero();
  double radius_a = 0.0, radius_b = 0.0;
  body::Part part = body::Part::kHead;
  std::int16_t bone = proxy::kNoBone;  ///< into Binding::joint_names
};

/// The signed distance to one shape, and the ball of its axis that a point is nearest to.
struct ShapeDistance {
  double distance = 0.0;        ///< meters, negative inside
  double along = 0.0;           ///< of that ball's center: 0 at a, 1 at b
  Vec3 normal = Vec3::UnitX();  ///< unit vector from that center to the point
};

/// The exact signed distance outside and down to the axis. O(1).
ShapeDistance shape_distance(const PlainShape& shape, const Vec3& point);

/// A ball around a shape. Most shapes are farther from a point than the nearest one, and the ball shows it
/// for a tenth of the exact distance's cost.
class BoundingBall {
 public:
  /// The ball around a valid shape. O(1).
  explicit BoundingBall(const PlainShape& shape);

  /// Whether the shape is surely farther from the point than a distance, in meters.
  bool is_farther(const Vec3& point, double distance_m) const {
    const double reach_m = radius_m_ + distance_m;
    return reach_m < 0.0 || (point - center_).squaredNorm() > reach_m * reach_m;
  }

 private:
  Vec3 center_;
  double radius_m_;
};

std::vector<BoundingBall> bounding_balls(std::span<const PlainShape> shapes);

}  // namespace bodice::colliders
