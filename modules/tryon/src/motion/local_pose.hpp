// Poses as local transforms of joints, and the ramps between them.
#pragma once

#include <span>
#include <vector>

#include <bodice/rig/rig.hpp>
#include <bodice/tryon/motion.hpp>

namespace bodice::inline v0_1::tryon {

/// Local transforms that give these world matrices, #J each.
void to_local_pose(const rig::Skeleton& skeleton, std::span<const rig::Affine> world,
                   std::span<rig::LocalTransform> local);

/// Local transforms that give the bind pose as world matrices.
std::vector<rig::LocalTransform> local_bind_pose(const rig::Skeleton& skeleton);

/// A ramp from a pose to a clip: `left_s` of its `length_s` are left.
struct Ramp {
  std::span<const rig::LocalTransform> from;  ///< #J
  double length_s = 0.0, left_s = 0.0;
};

/// The local transform of each joint (#J) while a ramp leads to a time of the clip; those of the clip where
/// nothing of the ramp is left. A ramp ends with the velocities that the clip has there. Allocates nothing.
/// `ahead` (#J) is scratch.
void sample_with_ramp(const BodyMotion& motion, double time_s, rig::Playback playback, const Ramp& ramp,
                      std::span<rig::LocalTransform> local, std::span<rig::LocalTransform> ahead);

}  // namespace bodice::tryon
