// Small skeletons with poses that can be computed by hand.
#pragma once

#include <numbers>

#include <bodice/rig/rig.hpp>

namespace rig_test {

/// A shoulder at the origin and an elbow one meter along x. Three vertices: upper arm, forearm, half of each.
inline bodice::rig::Rig arm() {
  using namespace bodice::rig;
  Rig rig;
  rig.skeleton.joints.resize(2);
  rig.skeleton.joints[0].name = "shoulder";
  rig.skeleton.joints[1].name = "elbow";
  rig.skeleton.joints[1].parent = 0;
  rig.skeleton.joints[1].local.translation = Vec3(1, 0, 0);
  rig.skeleton.joints[1].bind.col(3) = Vec3(1, 0, 0);
  rig.weights = {{0, 1, 2, 4}, {0, 1, 0, 1}, {1.0f, 1.0f, 0.5f, 0.5f}};
  return rig;
}

/// Second 0: straight; second 1: the elbow turned by 90 degrees about z.
inline bodice::rig::Clip elbow_bent_90() {
  using namespace bodice::rig;
  Clip clip{"bend", 1.0, {}};
  Track track;
  track.joint = 1;
  track.rotation.time_s = {0.0, 1.0};
  track.rotation.value = {Eigen::Quaterniond::Identity(),
                          Eigen::Quaterniond(Eigen::AngleAxisd(std::numbers::pi / 2, Vec3::UnitZ()))};
  clip.tracks.push_back(track);
  return clip;
}

}  // namespace rig_test
