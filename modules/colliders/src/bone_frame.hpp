// Where the shapes of a bone stand in the joint's own coordinates.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include <bodice/colliders/plain_shape.hpp>

namespace bodice::inline v0_1::colliders {

/// The coordinates of a joint in the bind pose, or those of the skin for what has no bone.
struct BoneFrame {
  std::string name;  ///< empty: no bone
  proxy::JointMatrix to_skin = proxy::JointMatrix::Identity();

  double scale() const { return std::cbrt(std::abs(to_skin.leftCols<3>().determinant())); }
  Vec3 to_local(const Vec3& point) const {
    return to_skin.leftCols<3>().inverse() * (point - to_skin.col(3));
  }
  /// The joint's axes without its scale, right-handed.
  Mat3 turn() const {
    Mat3 axes;
    axes.col(0) = to_skin.col(0).normalized();
    axes.col(1) = (to_skin.col(1) - axes.col(0) * axes.col(0).dot(to_skin.col(1))).normalized();
    axes.col(2) = axes.col(0).cross(axes.col(1));
    return axes;
  }
};

inline BoneFrame frame_of(const proxy::BodyProxy& proxy, std::int16_t bone) {
  BoneFrame frame;
  if (bone == proxy::kNoBone || !proxy.binding()) return frame;
  frame.name = proxy.binding()->joint_names[static_cast<std::size_t>(bone)];
  frame.to_skin = proxy.binding()->bind[static_cast<std::size_t>(bone)];
  return frame;
}

/// The bones of some items with a member `bone`, each once, in order of their numbers.
template <class Items>
std::vector<std::int16_t> bones_of(const Items& items) {
  std::vector<std::int16_t> bones;
  for (const auto& item : items) bones.push_back(item.bone);
  std::ranges::sort(bones);
  bones.erase(std::unique(bones.begin(), bones.end()), bones.end());
  return bones;
}

/// A shape in the coordinates of its bone.
inline PlainShape in_bone(const PlainShape& shape, const BoneFrame& frame) {
  PlainShape local = shape;
  local.a = frame.to_local(shape.a), local.b = frame.to_local(shape.b);
  local.radius_a /= frame.scale(), local.radius_b /= frame.scale();
  return local;
}

inline bool is_sphere(const PlainShape& shape) {
  return shape.a == shape.b;
}

/// Ten nanometers are enough for a collider, and shorter to read than a double.
inline double tidy(double value) {
  return std::round(value * 1e8) / 1e8 + 0.0;
}

std::string unity_text(const proxy::BodyProxy& proxy, std::span<const PlainShape> shapes);
std::string unreal_text(const proxy::BodyProxy& proxy, std::span<const PlainShape> shapes);
std::string godot_text(const proxy::BodyProxy& proxy, std::span<const PlainShape> shapes);
std::string vrm_text(const proxy::BodyProxy& proxy, std::span<const PlainShape> shapes);
std::string mujoco_text(const proxy::BodyProxy& proxy);
std::string sdformat_text(const proxy::BodyProxy& proxy);

}  // namespace bodice::colliders
