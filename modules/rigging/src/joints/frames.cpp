#include "joints/frames.hpp"

#include <algorithm>
#include <cmath>

#include <bodice/geometry/smallest_turn.hpp>

namespace bodice::inline v0_1::rigging {
namespace {

// The sines of the bends of a hinge, 14 and 30 degrees, between which the weight of its plane rises from 0 to
// 1.
constexpr double kUncertainBend = 0.24, kCertainBend = 0.5;
// The cosine of the angle from hanging, 120 degrees, beyond which an arm is turned by its side.
constexpr double kRaised = -0.5;

}  // namespace

Mat3 frame_of(const Vec3& across, const Vec3& upward) {
  Mat3 frame;
  const Vec3 x = across.normalized();
  const Vec3 z = x.cross(upward).normalized();
  frame << x, z.cross(x), z;
  return frame;
}

Mat3 bone_frame(const Mat3& parent, const Vec3& along) {
  return geometry::smallest_turn(-parent.col(1), along).toRotationMatrix() * parent;
}

Mat3 upper_arm_frame(const Mat3& chest, const Vec3& along, double sign) {
  if (along.dot(-chest.col(1)) > kRaised) return bone_frame(chest, along);
  const Mat3 level = bone_frame(chest, sign * chest.col(0));
  return bone_frame(level, along);
}

Mat3 with_hinge(const Mat3& bone, const Vec3& next_along, double sign) {
  const Vec3 axis = -bone.col(1);
  const Vec3 bend = sign * (next_along - next_along.dot(axis) * axis);
  const double trust = std::clamp((bend.norm() - kUncertainBend) / (kCertainBend - kUncertainBend), 0.0, 1.0);
  if (trust == 0.0) return bone;
  const double angle_rad = std::atan2(axis.dot(bone.col(2).cross(bend)), bone.col(2).dot(bend));
  return Eigen::AngleAxisd(trust * angle_rad, axis).toRotationMatrix() * bone;
}

}  // namespace bodice::rigging
