#include <bodice/rig/skeleton.hpp>

#include <algorithm>
#include <cmath>
#include <string>

#include "skeleton_errors.hpp"
#include "tolerances.hpp"

namespace bodice::inline v0_1::rig {

namespace {

engine::Result<void> check_parent(const Skeleton& skeleton, std::size_t j) {
  const std::int32_t parent = skeleton.joints[j].parent;
  if (parent < kNoParent || parent >= static_cast<std::int32_t>(skeleton.joints.size()))
    return unusable(
        joint_label(skeleton, j) + " has the parent " + std::to_string(parent) + ", which does not exist.",
        "Give the index of another joint, or -1 for a root.");
  if (parent >= static_cast<std::int32_t>(j))
    return unusable(joint_label(skeleton, j) + " stands before its parent.",
                    "Order the joints with put_parents_first().");
  return {};
}

engine::Result<void> check_transforms(const Skeleton& skeleton, std::size_t j) {
  const Joint& joint = skeleton.joints[j];
  const LocalTransform& local = joint.local;
  if (!local.translation.allFinite() || !local.rotation.coeffs().allFinite() || !local.scale.allFinite())
    return unusable(joint_label(skeleton, j) + " has a local transform that is not finite.",
                    "Remove the joint or export the rig again.");
  if (!(local.rotation.norm() > 0.0))
    return unusable(joint_label(skeleton, j) + " has a rotation of length zero.",
                    "Give it a unit quaternion, such as 0 0 0 1.");
  if (!is_invertible(to_affine(local)))
    return unusable(joint_label(skeleton, j) + " is scaled to zero.",
                    "Give it a scale other than zero along each axis.");
  if (!is_invertible(joint.bind))
    return unusable(
        joint_label(skeleton, j) + " has no inverse bind matrix: its bind matrix is singular or not finite.",
        "Bind the skin again and export its bind pose.");
  return {};
}

}  // namespace

Affine to_affine(const LocalTransform& transform) {
  const Mat3 rotation = transform.rotation.normalized().toRotationMatrix();
  return affine(rotation * transform.scale.asDiagonal(), transform.translation);
}

LocalTransform to_local_transform(const Affine& map) {
  LocalTransform result;
  result.translation = map.col(3);
  Mat3 linear = linear_of(map);
  result.scale = linear.colwise().norm().transpose();
  if (linear.determinant() < 0.0) result.scale.x() = -result.scale.x();
  for (int k = 0; k < 3; ++k)
    if (result.scale[k] != 0.0) linear.col(k) /= result.scale[k];
  result.rotation = Eigen::Quaterniond(linear).normalized();
  return result;
}

bool has_shear(const Affine& map) {
  const Mat3 linear = linear_of(map).colwise().normalized();
  return std::max({std::abs(linear.col(0).dot(linear.col(1))), std::abs(linear.col(1).dot(linear.col(2))),
                   std::abs(linear.col(2).dot(linear.col(0)))}) > kShear;
}

engine::Result<void> validate(const Skeleton& skeleton) {
  if (skeleton.joints.size() > kMaxJoints)
    return unusable("The skeleton has " + std::to_string(skeleton.joints.size()) + " joints; " +
                        std::to_string(kMaxJoints) + " are the most that a rig can have.",
                    "Remove joints that move no skin.");
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    if (auto checked = check_parent(skeleton, j); !checked) return checked;
    if (auto checked = check_transforms(skeleton, j); !checked) return checked;
  }
  return {};
}

std::optional<std::size_t> find_joint(const Skeleton& skeleton, std::string_view name) {
  const auto found = std::find_if(skeleton.joints.begin(), skeleton.joints.end(),
                                  [&](const Joint& joint) { return joint.name == name; });
  if (found == skeleton.joints.end()) return std::nullopt;
  return static_cast<std::size_t>(found - skeleton.joints.begin());
}

void rest_matrices(const Skeleton& skeleton, std::span<Affine> world) {
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    const Joint& joint = skeleton.joints[j];
    const Affine local = to_affine(joint.local);
    world[j] = joint.parent < 0 ? local : compose(world[static_cast<std::size_t>(joint.parent)], local);
  }
}

void bind_matrices(const Skeleton& skeleton, std::span<Affine> world) {
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) world[j] = skeleton.joints[j].bind;
}

}  // namespace bodice::rig
