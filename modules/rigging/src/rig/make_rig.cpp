#include <bodice/rigging/make_rig.hpp>

#include <bodice/engine/catch_canceled.hpp>
#include <bodice/engine/stage_timer.hpp>

#include "weights/heat.hpp"

namespace bodice::inline v0_1::rigging {
namespace {

using body::JointId;
using engine::StageTimer;

rig::Skeleton skeleton_of(const FoundJoints& found) {
  rig::Skeleton skeleton;
  for (int i = 0; i < body::kJointCount; ++i) {
    const auto id = static_cast<JointId>(i);
    rig::Joint joint;
    joint.name = std::string(body::name(id));
    joint.bind = rig::affine(found.axes(id), found.at(id));
    joint.parent = id == JointId::kPelvis ? rig::kNoParent : static_cast<int>(body::parent(id));
    joint.local = rig::to_local_transform(
        joint.parent < 0 ? joint.bind
                         : rig::compose(rig::inverse(skeleton.joints[joint.parent].bind), joint.bind));
    skeleton.joints.push_back(std::move(joint));
  }
  return skeleton;
}

engine::Result<FoundRig> find_rig(const engine::Context& context, const geometry::TriMesh& skin,
                                  const anatomy::Anatomy& anatomy) {
  FoundRig result;
  result.warnings = anatomy.warnings;
  StageTimer joints_timer(context, result.stages, "joints");
  const SkinCurves curves(context, skin, anatomy);
  const auto joints = find_joints(curves);
  if (!joints) return joints.error();
  result.rig.skeleton = skeleton_of(*joints);
  joints_timer.stop();
  StageTimer weights_timer(context, result.stages, "weights");
  auto weights = heat_weights(context, curves, nearest_bones(context, curves, *joints));
  if (!weights) return std::move(weights).error();
  result.rig.weights = std::move(weights).value();
  weights_timer.stop();
  return result;
}

}  // namespace

engine::Result<FoundRig> make_rig(const engine::Context& context, const geometry::TriMesh& skin,
                                  const anatomy::Anatomy& anatomy) {
  return engine::catch_canceled("The making of the rig", [&]() -> engine::Result<FoundRig> {
    return find_rig(context, skin, anatomy);
  });
}

}  // namespace bodice::rigging
