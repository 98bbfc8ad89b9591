#include "motion/clip_playback.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "motion/local_pose.hpp"

namespace bodice::inline v0_1::tryon {

ClipPlayback::ClipPlayback(std::shared_ptr<const BodyMotion> motion, rig::Playback playback)
    : motion_(std::move(motion)),
      playback_(playback),
      from_(local_bind_pose(motion_->rig.skeleton)),
      local_(from_.size()),
      ahead_(from_.size()),
      world_(from_.size()) {
  find_joints(0.0, 0.0, world_);
}

void ClipPlayback::seek(double time_s, double ramp_s) {
  to_local_pose(motion_->rig.skeleton, world_, from_);
  time_s_ = std::isfinite(time_s) ? std::max(0.0, time_s) : 0.0;
  ramp_s_ = ramp_left_s_ = std::isfinite(ramp_s) ? std::max(0.0, ramp_s) : 0.0;
  find_joints(time_s_, ramp_left_s_, world_);
}

void ClipPlayback::start_from_bind(double time_s, double ramp_s) {
  for (std::size_t j = 0; j < world_.size(); ++j) world_[j] = motion_->rig.skeleton.joints[j].bind;
  seek(time_s, ramp_s);
}

void ClipPlayback::start_from(std::span<const rig::Affine> world, double time_s, double ramp_s) {
  std::ranges::copy(world, world_.begin());
  seek(time_s, ramp_s);
}

void ClipPlayback::continue_from(const ClipPlayback& other) {
  start_from_bind(other.time_s_, other.ramp_s_);
  ramp_left_s_ = other.ramp_left_s_;
  find_joints(time_s_, ramp_left_s_, world_);
}

void ClipPlayback::advance(double dt_s) {
  const double on_ramp_s = std::min(ramp_left_s_, dt_s);
  ramp_left_s_ -= on_ramp_s;
  time_s_ += dt_s - on_ramp_s;
  find_joints(time_s_, ramp_left_s_, world_);
}

void ClipPlayback::joints_ahead(double ahead_s, std::span<rig::Affine> world) {
  const double on_ramp_s = std::min(ramp_left_s_, ahead_s);
  find_joints(time_s_ + ahead_s - on_ramp_s, ramp_left_s_ - on_ramp_s, world);
}

void ClipPlayback::find_joints(double time_s, double ramp_left_s, std::span<rig::Affine> world) {
  sample_with_ramp(*motion_, time_s, playback_, {from_, ramp_s_, ramp_left_s}, local_, ahead_);
  rig::world_matrices(motion_->rig.skeleton, local_, world);
}

}  // namespace bodice::tryon
