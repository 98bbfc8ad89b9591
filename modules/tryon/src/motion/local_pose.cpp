#include "motion/local_pose.hpp"

#include <bodice/rig/lead.hpp>

namespace bodice::inline v0_1::tryon {
namespace {

// The transform between a and b, with the weight `share` of b.
rig::LocalTransform between(const rig::LocalTransform& a, const rig::LocalTransform& b, double share) {
  return {.translation = (1.0 - share) * a.translation + share * b.translation,
          .rotation = a.rotation.slerp(share, b.rotation),
          .scale = (1.0 - share) * a.scale + share * b.scale};
}

// The transform as far before `now` as `next` is after it. The scale stays, because it must not pass through
// zero.
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
  // A body that stands still when its clip begins would throw off tight cloth in the first frame. So the ramp
  // leads to poses before the clip: its first moments mirrored in time, which have the clip's velocity where
  // they meet it. The moments ahead are taken without looping, because a clip may jump where it starts over.
  const double lead_s = rig::lead_s(ramp.left_s);
  rig::sample(skeleton, motion.clip, rig::time_in_clip(motion.clip, time_s, playback) + lead_s, ahead);
  const double share = rig::smooth_step(1.0 - ramp.left_s / ramp.length_s);
  for (std::size_t j = 0; j < local.size(); ++j)
    local[j] = between(ramp.from[j], mirrored(local[j], ahead[j]), share);
}

}  // namespace bodice::tryon
