// Base poses that `fit` makes beforehand.
#pragma once

#include <string>
#include <vector>

#include <bodice/proxy/base_pose.hpp>
#include <bodice/tryon/prepare.hpp>
#include <bodice/tryon/rigged_body.hpp>

namespace bodice::inline v0_1::cli {

/// What to prepare.
struct PosesToPrepare {
  std::vector<std::string> poses;  ///< MOTION or MOTION@SECONDS; a made motion without seconds: its far pose
  tryon::MotionChoice motion;      ///< a clip to prepare from its begin to its end; empty: none

  bool any() const { return !poses.empty() || !motion.motion.empty(); }
};

/// Solves the tables of a bound proxy in all of these poses. Fails where a motion is not found, seconds are
/// not a number, or a pose is refused.
engine::Result<proxy::BasePoses> prepare_poses(const engine::Context& context,
                                               const tryon::PreparedBody& body, const PosesToPrepare& wanted,
                                               std::vector<engine::Warning>& warnings);

/// Solves the tables of a bound proxy in the pose of some joints, for the body in a file: that which the
/// proxy was fitted to. Fails where the file has no rig with the proxy's joints.
engine::Result<std::shared_ptr<const proxy::BasePose>> refit_for(const engine::Context& context,
                                                                 const proxy::BodyProxy& bound,
                                                                 const std::string& body_file,
                                                                 std::span<const proxy::JointMatrix> joints);

}  // namespace bodice::cli
