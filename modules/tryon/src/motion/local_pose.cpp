#include "motion/local_pose.hpp"

#include <bodice/rig/lead.hpp>

namespace bodice::inline v0_1::tryon {
namespace {

// The transform that is `share` of what leads from a to b.
rig::LocalTransform between(const rig::LocalTransform& a, const rig::LocalTransform& b, double share) {
  return {.translation = (1.0 - share) * a.translation + share * b.translation,
          .rotation = a.rotation.slerp(share, b.rotation),
          .scale = (1.0 - share) * a.scale + share * b.scale};
}

// What lies as far before `now` as `next` after it. A scale stays, because it may not pass through zero.
rig::LocalTransform mirrored(const rig::LocalTransform& now, const rig::LocalTransform& next) {
  return {.translation = rig::mirrored(now.translation, next.translation),
          .rotation = rig::mirrored(now.rotation, next.rotation),
          .scale = now.scale};
}

}  // namespace

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

void sample_with_ramp(const BodyMotion& motion, double time_s, rig::Playback playback, const Ramp& ramp,
                      std::span<rig::LocalTransform> local, std::span<rig::LocalTransform> ahead) {
  const rig::Skeleton& skeleton = motion.rig.skeleton;
  rig::sample(skeleton, motion.clip, time_s, local, playback);
  if (!(ramp.left_s > 0.0)) return;
  // A body that stood still when its clip begins would throw tight cloth off in the first frame. So the ramp
  // leads to what the clip would have been before: its next moments mirrored in time, which have the same
  // velocity where they meet the clip. A clip that starts over may jump there, and none leads beyond a jump.
  const double lead_s = rig::lead_s(ramp.left_s);
  rig::sample(skeleton, motion.clip, rig::time_in_clip(motion.clip, time_s, playback) + lead_s, ahead);
  const double share = rig::smooth_step(1.0 - ramp.left_s / ramp.length_s);
  for (std::size_t j = 0; j < local.size(); ++j)
    local[j] = between(ramp.from[j], mirrored(local[j], ahead[j]), share);
}

}  // namespace bodice::tryon
