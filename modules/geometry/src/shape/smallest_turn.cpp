#include <bodice/geometry/smallest_turn.hpp>

#include <cmath>

namespace bodice::geometry {
namespace {

/// A cosine closer than this to -1 leaves no digits of an axis in the cross product.
constexpr double kOpposite = 1e-12;

}  // namespace

Eigen::Quaterniond smallest_turn(const Vec3& from, const Vec3& to) {
  const Vec3 a = from.normalized(), b = to.normalized();
  const double cosine = b.dot(a);
  Eigen::Quaterniond turn;
  if (cosine < -1.0 + kOpposite) {
    turn.w() = 0.0;
    turn.vec() = a.unitOrthogonal();
    return turn;
  }
  const double twice_w = std::sqrt((1.0 + cosine) * 2.0);
  turn.vec() = a.cross(b) * (1.0 / twice_w);
  turn.w() = 0.5 * twice_w;
  return turn;
}

}  // namespace bodice::geometry
