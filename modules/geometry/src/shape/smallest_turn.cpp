#include <bodice/geometry/smallest_turn.hpp>

#include <cmath>

namespace bodice::inline v0_1::geometry {
namespace {

/// The cosine below which 1 + cosine has lost digits, and the sum of both directions has not.
constexpr double kNearlyOpposite = -0.9;
/// A shorter sum leaves no axis: the cross product has lost half of its digits.
constexpr double kOpposite = 1e-8;

}  // namespace

Eigen::Quaterniond smallest_turn(const Vec3& from, const Vec3& to) {
  const Vec3 a = from.normalized(), b = to.normalized();
  const double cosine = b.dot(a);
  Eigen::Quaterniond turn;
  const double twice_w = cosine < kNearlyOpposite ? (a + b).norm() : std::sqrt((1.0 + cosine) * 2.0);
  if (twice_w < kOpposite) {
    turn.w() = 0.0;
    turn.vec() = a.unitOrthogonal();
    return turn;
  }
  turn.vec() = a.cross(b) * (1.0 / twice_w);
  turn.w() = 0.5 * twice_w;
  return turn;
}

}  // namespace bodice::geometry
