// Poses as the local transforms of joints, between which a ramp leads.
#pragma once

#include <span>
#include <vector>

#include <bodice/rig/rig.hpp>

namespace bodice::tryon {

/// Local transforms that give these world matrices, #J each.
void to_local_pose(const rig::Skeleton& skeleton, std::span<const rig::Affine> world,
                   std::span<rig::LocalTransform> local);

/// Local transforms that give the bind pose as world matrices.
std::vector<rig::LocalTransform> local_bind_pose(const rig::Skeleton& skeleton);

/// From 0 to 1 without a jerk at either end.
double smooth_step(double share);

/// The transform that is `share` of what leads from a to b.
rig::LocalTransform between(const rig::LocalTransform& a, const rig::LocalTransform& b, double share);

}  // namespace bodice::tryon
