// A made body with a rig and a bound proxy, and poses of it.
#pragma once

#include <map>
#include <string>
#include <vector>

#include <bodice/binding/bind.hpp>
#include <bodice/binding/poser.hpp>
#include <bodice/synth/body.hpp>

namespace binding_test {

using bodice::proxy::JointMatrix;
using Pose = std::vector<JointMatrix>;  ///< joint space to world, #J

struct MovingBody {
  bodice::synth::Body body;
  bodice::proxy::BodyProxy bound;
};

/// Made and fitted once for all cases: 60 ellipsoids with relief, found on the flexed skin.
const MovingBody& moving_body();

/// The bind pose.
Pose bind_pose(const bodice::rig::Skeleton& skeleton);

/// The bind pose with some joints turned about an axis of the body, in degrees.
struct Turn {
  bodice::geometry::Vec3 axis;
  double degrees = 0.0;
};
Pose turned(const bodice::rig::Skeleton& skeleton, const std::map<std::string, Turn>& turns);

/// Thighs forward and knees bent by 90 degrees.
Pose seat(const bodice::rig::Skeleton& skeleton);
/// Arms raised by 70 degrees, one knee up.
Pose march(const bodice::rig::Skeleton& skeleton);
/// A stride of a run, the left leg ahead.
Pose stride(const bodice::rig::Skeleton& skeleton);
/// Thighs forward by 115 degrees and knees bent by 130.
Pose squat(const bodice::rig::Skeleton& skeleton);
/// Arms raised by 150 degrees.
Pose arms_up(const bodice::rig::Skeleton& skeleton);

/// Every matrix after a map of the world.
Pose moved(const JointMatrix& map, Pose pose);

/// The skin in a pose, by linear blend skinning.
bodice::geometry::TriMesh posed_skin(const MovingBody& moving, const Pose& pose);

/// A poser of the body; the bound proxy is valid.
bodice::binding::Poser make_poser(const MovingBody& moving);

}  // namespace binding_test
