#include "motion/local_pose.hpp"

#include <algorithm>
#include <cmath>

namespace bodice::inline v0_1::tryon {
namespace {

// A body that stood still when its clip begins would throw tight cloth off in the first frame. So a ramp
// leads to what the clip would have been before: its next moments mirrored in time, which have the same
// velocity where they meet the clip. They slow down to end this far away, because all of a fast clip,
// mirrored, would bend joints too far.
constexpr double kLead_s = 0.1;

// A weight that rises from 0 to 1 without a jerk at either end.
double smooth_step(double share) {
  const double t = std::clamp(share, 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

// The transform that is `share` of what leads from a to b.
rig::LocalTransform between(const rig::LocalTransform& a, const rig::LocalTransform& b, double share) {
  return {.translation = (1.0 - share) * a.translation + share * b.translation,
          .rotation = a.rotation.slerp(share, b.rotation),
          .scale = (1.0 - share) * a.scale + share * b.scale};
}

// What lies as far before `now` as `next` after it. A scale stays, because it may not pass through zero.
rig::LocalTransform mirrored(const rig::LocalTransform& now, const rig::LocalTransform& next) {
  return {.translation = 2.0 * now.translation - next.translation,
          .rotation = now.rotation * next.rotation.conjugate() * now.rotation,
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
  // A clip that starts over may jump there, and no ramp leads to what is beyond a jump.
  const double lead_s = kLead_s * std::tanh(ramp.left_s / kLead_s);
  rig::sample(skeleton, motion.clip, rig::time_in_clip(motion.clip, time_s, playback) + lead_s, ahead);
  const double share = smooth_step(1.0 - ramp.left_s / ramp.length_s);
  for (std::size_t j = 0; j < local.size(); ++j)
    local[j] = between(ramp.from[j], mirrored(local[j], ahead[j]), share);
}

}  // namespace bodice::tryon
