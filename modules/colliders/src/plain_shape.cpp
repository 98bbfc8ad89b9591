#include <algorithm>
#include <array>
#include <cmath>

#include <bodice/colliders/plain_shape.hpp>

namespace bodice::inline v0_1::colliders {
namespace {

/// Balls are larger by this share, so that rounding never makes a distance that ties look larger.
constexpr double kRounding = 1e-12;

constexpr std::array<std::string_view, 3> kKindNames = {"spheres", "capsules", "tapered"};

}  // namespace

std::string_view name(ShapeKind kind) {
  return kKindNames[static_cast<std::size_t>(kind)];
}

std::optional<ShapeKind> shape_kind_from_name(std::string_view text) {
  for (std::size_t i = 0; i < kKindNames.size(); ++i)
    if (kKindNames[i] == text) return static_cast<ShapeKind>(i);
  return std::nullopt;
}

ShapeDistance shape_distance(const PlainShape& shape, const Vec3& point) {
  const Vec3 axis = shape.b - shape.a;
  const double length = axis.norm(), slope = length > 0.0 ? (shape.radius_b - shape.radius_a) / length : 0.0;
  double along = 0.0;
  if (length > 0.0 && std::abs(slope) < 1.0) {
    const Vec3 from_a = point - shape.a;
    const double y = from_a.dot(axis) / length;
    const double aside = std::sqrt(std::max(0.0, from_a.squaredNorm() - y * y));
    along = std::clamp((y + aside * slope / std::sqrt(1.0 - slope * slope)) / length, 0.0, 1.0);
  } else if (length > 0.0) {
    along = slope > 0.0 ? 1.0 : 0.0;  // one ball contains the other
  }
  const Vec3 away = point - (shape.a + along * axis);
  const double far = away.norm();
  return {far - (shape.radius_a + along * (shape.radius_b - shape.radius_a)), along,
          far > 0.0 ? Vec3(away / far) : Vec3(Vec3::UnitX())};
}

BoundingBall::BoundingBall(const PlainShape& shape)
    : center_(0.5 * (shape.a + shape.b)),
      radius_m_((1.0 + kRounding) *
                    (0.5 * (shape.b - shape.a).norm() + std::max(shape.radius_a, shape.radius_b)) +
                kRounding * center_.norm()) {}

std::vector<BoundingBall> bounding_balls(std::span<const PlainShape> shapes) {
  return {shapes.begin(), shapes.end()};
}

}  // namespace bodice::colliders
