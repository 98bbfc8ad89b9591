// Clips: keys over time that move the joints of a skeleton.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <bodice/engine/result.hpp>
#include <bodice/rig/skeleton.hpp>

namespace bodice::inline v0_1::rig {

/// How values between two keys come about: the earlier key's value; a straight line (great arc for
/// rotations); or a cubic Hermite spline through the keys with their tangents.
enum class Interpolation : std::uint8_t { kStep, kLinear, kCubic };

/// Values over time. Before the first key and after the last one, the nearest key's value holds.
template <class T>
struct Keys {
  Interpolation interpolation = Interpolation::kLinear;
  std::vector<double> time_s;  ///< #K, never decreasing
  /// #K; for kCubic 3 x #K: incoming tangent, value, outgoing tangent of each key, tangents per second.
  std::vector<T> value;

  bool empty() const { return time_s.empty(); }
};

/// The keys of one joint. A kind of key that is absent leaves the joint's own local value.
struct Track {
  std::uint16_t joint = 0;
  Keys<Vec3> translation;     ///< meters
  Keys<Quaternion> rotation;  ///< unit quaternions
  Keys<Vec3> scale;
};

/// What happens to times outside of [0, duration_s].
enum class Playback : std::uint8_t { kClamp, kLoop };

/// A named motion: the keys of the joints that it moves, and its length.
struct Clip {
  std::string name;
  double duration_s = 0.0;
  std::vector<Track> tracks;  ///< at most one a joint, in increasing order of the joint
};

/// Checks that joints exist, times are finite and do not decrease, and values are finite, rotations not zero,
/// scales not zero. Fails with kUnusableGeometry and names clip, joint and remedy. O(#keys).
engine::Result<void> validate(const Clip& clip, const Skeleton& skeleton);

/// The time inside the clip that `time_s` stands for: clamped to [0, duration_s], or modulo the duration. A
/// time that is not a number counts as 0.
double time_in_clip(const Clip& clip, double time_s, Playback playback);

/// Local transform of each joint at a time, #J. Joints without keys keep their own. Allocates nothing.
/// O(#J + #tracks log #keys). Precondition: both valid, local.size() == #J.
void sample(const Skeleton& skeleton, const Clip& clip, double time_s, std::span<LocalTransform> local,
            Playback playback = Playback::kClamp);

/// World matrix of each joint (joint space to world, #J) at a time. The same bits as sample() and
/// world_matrices(). Precondition: both valid, world.size() == #J. Thread-safe, allocates nothing. O(#J +
/// #tracks log #keys).
void joint_matrices(const Skeleton& skeleton, const Clip& clip, double time_s, std::span<Affine> world,
                    Playback playback = Playback::kClamp);

/// World matrices of local transforms: each joint's parent's world matrix times its own local one. #J each.
void world_matrices(const Skeleton& skeleton, std::span<const LocalTransform> local, std::span<Affine> world);

}  // namespace bodice::rig
