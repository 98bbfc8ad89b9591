// The playback of a clip, frame by frame: it can pause, loop, move to another time, and start with a ramp.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include <bodice/tryon/motion.hpp>

namespace bodice::inline v0_1::tryon {

/// The joints of a body over the frames of a session. A ramp leads from another pose to that of the clip; the
/// time of the clip stands still meanwhile. Only the constructor allocates.
class ClipPlayback {
 public:
  ClipPlayback(std::shared_ptr<const BodyMotion> motion, rig::Playback playback);

  const BodyMotion& motion() const noexcept { return *motion_; }

  /// Moves to a second of the clip, at once or over `ramp_s` from the pose in force.
  void seek(double time_s, double ramp_s);
  /// The same from the bind pose, or from joints of this skeleton in another pose (#J, world).
  void start_from_bind(double time_s, double ramp_s);
  void start_from(std::span<const rig::Affine> world, double time_s, double ramp_s);
  /// Continues at the time and ramp of another body's playback of the same clip.
  void continue_from(const ClipPlayback& other);
  /// Advances by dt_s: the ramp first, then the clip.
  void advance(double dt_s);

  double time_s() const noexcept {
    return time_s_;
  }  ///< time of the clip; it goes on rising where the clip loops
  double ramp_left_s() const noexcept { return ramp_left_s_; }  ///< 0: the clip's own pose is shown
  /// #J: joint space to world of the pose in force.
  std::span<const rig::Affine> joints() const noexcept { return world_; }
  /// The joints after a further `ahead_s`.
  void joints_ahead(double ahead_s, std::span<rig::Affine> world);

 private:
  void find_joints(double time_s, double ramp_left_s, std::span<rig::Affine> world);

  std::shared_ptr<const BodyMotion> motion_;
  rig::Playback playback_;
  double time_s_ = 0.0, ramp_s_ = 0.0, ramp_left_s_ = 0.0;
  std::vector<rig::LocalTransform> from_;           // #J: where the ramp began
  std::vector<rig::LocalTransform> local_, ahead_;  // #J: scratch
  std::vector<rig::Affine> world_;                  // #J
};

}  // namespace bodice::tryon
