// Rotations that take the axes of the body in the reference pose to those of a joint in the pose of a skin.
#pragma once

#include <Eigen/Geometry>

#include <bodice/geometry/types.hpp>

namespace bodice::inline v0_1::rigging {

using geometry::Mat3;
using geometry::Vec3;

/// Axes x along `across` and y as near to `upward` as that allows; z completes them. Both must not be
/// parallel.
Mat3 frame_of(const Vec3& across, const Vec3& upward);

/// The frame of a bone that runs along -y of its frame: `parent` turned as little as possible.
Mat3 bone_frame(const Mat3& parent, const Vec3& along);

/// The frame of an upper arm. Where the arm is raised over the shoulder it is turned by its side and not by
/// its front. `sign` is 1 for the left arm, -1 for the right one.
Mat3 upper_arm_frame(const Mat3& chest, const Vec3& along, double sign);

/// Turns a bone's frame about its own axis so that the next bone bends in its y-z plane, to +z times `sign`;
/// by less where the joint is nearly straight and its plane uncertain.
Mat3 with_hinge(const Mat3& bone, const Vec3& next_along, double sign);

}  // namespace bodice::rigging
