// A skeleton: joints in a hierarchy, with the pose in which the skin was bound to them.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Geometry>

#include <bodice/engine/result.hpp>
#include <bodice/rig/affine.hpp>

namespace bodice::inline v0_1::rig {

/// Joints are addressed by 16 bits, of which one value stays free.
inline constexpr std::size_t kMaxJoints = 65535;
/// The parent of a root.
inline constexpr std::int32_t kNoParent = -1;

/// Joint space to the space of its parent: p -> translation + rotation (scale * p), meters.
struct LocalTransform {
  Vec3 translation = Vec3::Zero();
  Quaternion rotation = Quaternion::Identity();
  Vec3 scale = Vec3::Ones();
};

/// The map of a local transform.
Affine to_affine(const LocalTransform& transform);

/// The transform nearest to a map: exact unless the map shears, which no translation, rotation and scale can
/// do. A reflection becomes a negative scale along x.
LocalTransform to_local_transform(const Affine& map);

/// Whether to_local_transform() would lose the map's shear.
bool has_shear(const Affine& map);

/// A joint: a coordinate system that its parent carries.
struct Joint {
  std::string name;
  std::int32_t parent = kNoParent;  ///< index of a joint before this one, or kNoParent for a root
  LocalTransform local;             ///< where no clip moves the joint
  Affine bind = identity();         ///< joint space to skin space (meters, y up) in the bind pose
};

/// The joints of a body as a forest.
struct Skeleton {
  std::vector<Joint> joints;  ///< #J, parents before children
};

/// Checks that there are at most kMaxJoints joints, that parents come before children, and that every
/// transform is finite and invertible. Fails with kUnusableGeometry, names the joint and gives the remedy.
/// O(#J).
engine::Result<void> validate(const Skeleton& skeleton);

/// The index of the first joint of this name.
std::optional<std::size_t> find_joint(const Skeleton& skeleton, std::string_view name);

/// World matrix of each joint (joint space to world, #J) where no clip moves any: the rest pose, which may
/// differ from the bind pose. Precondition: a valid skeleton, world.size() == #J. Allocates nothing. O(#J).
void rest_matrices(const Skeleton& skeleton, std::span<Affine> world);

/// World matrices of the bind pose: joint.bind of each joint, #J.
void bind_matrices(const Skeleton& skeleton, std::span<Affine> world);

}  // namespace bodice::rig
