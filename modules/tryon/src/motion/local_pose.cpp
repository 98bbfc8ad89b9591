#include "motion/local_pose.hpp"

#include <algorithm>

namespace bodice::tryon {

void to_local_pose(const rig::Skeleton& skeleton, std::span<const rig::Affine> world,
                   std::span<rig::LocalTransform> local) {
  for (std::size_t j = 0; j < local.size(); ++j) {
    const std::int32_t parent = skeleton.joints[j].parent;
    local[j] = rig::to_local_transform(
        parent == rig::kNoParent
            ? world[j]
            : rig::compose(rig::inverse(world[static_cast<std::size_t>(parent)]), world[j]));
  }
}

std::vector<rig::LocalTransform> local_bind_pose(const rig::Skeleton& skeleton) {
  std::vector<rig::Affine> world;
  for (const rig::Joint& joint : skeleton.joints) world.push_back(joint.bind);
  std::vector<rig::LocalTransform> local(world.size());
  to_local_pose(skeleton, world, local);
  return local;
}

double smooth_step(double share) {
  const double t = std::clamp(share, 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

rig::LocalTransform between(const rig::LocalTransform& a, const rig::LocalTransform& b, double share) {
  return {.translation = (1.0 - share) * a.translation + share * b.translation,
          .rotation = a.rotation.slerp(share, b.rotation),
          .scale = (1.0 - share) * a.scale + share * b.scale};
}

}  // namespace bodice::tryon
