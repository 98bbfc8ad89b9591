// Motions for the common skeleton: clips made here, for any body that has one.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include <bodice/engine/result.hpp>
#include <bodice/rig/clip.hpp>

namespace bodice::inline v0_1::rigging {

/// A motion that make_clip() makes for any common skeleton.
enum class Motion : std::uint8_t {
  kWalk,    ///< one cycle of two steps in 1.1 s
  kRun,     ///< one cycle of two steps in 0.7 s, with a phase of flight
  kTurn,    ///< once around in 4 s, in twelve steps
  kSpin,    ///< twice around in a second, on both soles: 720 degrees a second
  kReach,   ///< the right arm overhead, then both to the front, and back, in 4 s
  kSit,     ///< from standing down to an absent seat in 2 s, then at rest until 3 s
  kSquat,   ///< down and up again in 3 s
  kArmsUp,  ///< both arms over the head and down again in 3 s
  kDance,   ///< steps to either side with arms, hips and turns, in 4 s
};

/// The number of motions.
inline constexpr int kMotionCount = 9;

/// The names of the motions in options, in the order of Motion.
inline constexpr std::array<std::string_view, kMotionCount> kMotionNames = {
    "walk", "run", "turn", "spin", "reach", "sit", "squat", "arms-up", "dance"};

/// The name of a motion, such as "arms-up".
constexpr std::string_view name(Motion motion) {
  return kMotionNames[static_cast<std::size_t>(motion)];
}

/// The motion of a name, if there is one.
constexpr std::optional<Motion> motion_from_name(std::string_view text) {
  for (std::size_t i = 0; i < kMotionCount; ++i)
    if (kMotionNames[i] == text) return static_cast<Motion>(i);
  return std::nullopt;
}

/// Whether the clip ends in the pose it begins with, so that it may loop. All do but kSit.
constexpr bool is_cyclic(Motion motion) {
  return motion != Motion::kSit;
}

/// How far standing and walking bodies hold their arms from upright, degrees, with MotionOptions as they are.
inline constexpr double kHangingRaise_deg = 10.0;

/// How a motion is made.
struct MotionOptions {
  /// Walking and running: true moves the body over the floor, so that soles rest on it; false keeps the body
  /// where it is, as on a treadmill, so that the clip loops: soles then travel backward with one speed.
  bool travel = false;
  double arms_out_deg = 0.0;  ///< added to how far arms are held from the trunk; see clear_arms_deg()
  /// Height of the floor, meters. Absent: it lies under the lower sole as bound, which is too high where a
  /// scan sits on the floor with its heels or toes up. The lowest vertex of the skin is right for most scans.
  std::optional<double> floor_m;
};

/// The motion as a clip of a skeleton. Legs are solved for the skeleton's lengths, so that soles stay on the
/// floor and where they were set down; everything else is a rotation of joints. The body begins where the
/// bind pose has it and faces as it does there, whatever that pose is.
/// Up is +y. Fails with kInvalidArgument when a joint of body::JointId is missing (a middle spine joint,
/// clavicles and toes may be) or carried by another one than there; the sentence names it. Deterministic.
/// O(#keys), below a millisecond.
engine::Result<rig::Clip> make_clip(const rig::Skeleton& skeleton, Motion motion,
                                    const MotionOptions& options = {});

/// Speed of a traveling walk or run on this skeleton, m/s; 0 for motions that stay. Same failures.
engine::Result<double> travel_speed_mps(const rig::Skeleton& skeleton, Motion motion);

}  // namespace bodice::rigging
