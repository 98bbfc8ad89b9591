#include "moving_body.hpp"

#include <numbers>

#include <doctest/doctest.h>

#include <Eigen/Geometry>

#include <bodice/binding/flexed_skin.hpp>
#include <bodice/fitting/fit.hpp>

namespace binding_test {

using namespace bodice;
using geometry::Vec3;

const MovingBody& moving_body() {
  static const MovingBody moving = [] {
    const engine::Context context;
    auto body = synth::make_body(context, {});
    REQUIRE(body);
    const geometry::MeshDistance distance(context, body->mesh);
    const fitting::LabeledSkin skin{body->mesh, body->part, body->stature_m, {}, &distance};
    const binding::SkinnedBody skinned{body->mesh, body->skeleton, body->weights};
    const std::vector<Vec3> flexed = binding::flexed_skin(context, skinned, body->part);
    fitting::FitOptions options;
    options.max_ellipsoids = 60;
    options.measure_accuracy = false;
    options.flexed = flexed;
    auto fitted = fitting::fit(context, skin, options);
    REQUIRE(fitted);
    auto bound = binding::bind(context, fitted->proxy, skinned);
    REQUIRE(bound);
    return MovingBody{std::move(*body), *bound};
  }();
  return moving;
}

Pose bind_pose(const rig::Skeleton& skeleton) {
  Pose pose;
  for (const rig::Joint& joint : skeleton.joints) pose.push_back(joint.bind);
  return pose;
}

Pose turned(const rig::Skeleton& skeleton, const std::map<std::string, Turn>& turns) {
  Pose skinning, pose;
  for (const rig::Joint& joint : skeleton.joints) {
    const auto found = turns.find(joint.name);
    JointMatrix own = rig::identity();
    if (found != turns.end()) {
      const Eigen::Matrix3d turn =
          Eigen::AngleAxisd(found->second.degrees / 180.0 * std::numbers::pi, found->second.axis)
              .toRotationMatrix();
      const Vec3 head = joint.bind.col(3);
      own = rig::affine(turn, head - turn * head);
    }
    skinning.push_back(
        joint.parent < 0 ? own : rig::compose(skinning[static_cast<std::size_t>(joint.parent)], own));
    pose.push_back(rig::compose(skinning.back(), joint.bind));
  }
  return pose;
}

Pose seat(const rig::Skeleton& skeleton) {
  const Vec3 left = Vec3::UnitX();
  return turned(skeleton, {{"thigh_l", {left, -90.0}},
                           {"thigh_r", {left, -90.0}},
                           {"calf_l", {left, 90.0}},
                           {"calf_r", {left, 90.0}}});
}

Pose march(const rig::Skeleton& skeleton) {
  return turned(skeleton, {{"upper_arm_l", {Vec3::UnitZ(), 70.0}},
                           {"upper_arm_r", {Vec3::UnitZ(), -70.0}},
                           {"thigh_l", {Vec3::UnitX(), -60.0}},
                           {"calf_l", {Vec3::UnitX(), 70.0}}});
}

Pose stride(const rig::Skeleton& skeleton) {
  return turned(skeleton, {{"thigh_l", {Vec3::UnitX(), -30.0}},
                           {"calf_l", {Vec3::UnitX(), 12.0}},
                           {"thigh_r", {Vec3::UnitX(), 22.0}},
                           {"calf_r", {Vec3::UnitX(), 35.0}},
                           {"upper_arm_l", {Vec3::UnitX(), 25.0}},
                           {"upper_arm_r", {Vec3::UnitX(), -25.0}}});
}

Pose squat(const rig::Skeleton& skeleton) {
  return turned(skeleton, {{"thigh_l", {Vec3::UnitX(), -115.0}},
                           {"thigh_r", {Vec3::UnitX(), -115.0}},
                           {"calf_l", {Vec3::UnitX(), 130.0}},
                           {"calf_r", {Vec3::UnitX(), 130.0}}});
}

Pose arms_up(const rig::Skeleton& skeleton) {
  return turned(skeleton,
                {{"upper_arm_l", {Vec3::UnitZ(), 150.0}}, {"upper_arm_r", {Vec3::UnitZ(), -150.0}}});
}

Pose moved(const JointMatrix& map, Pose pose) {
  for (JointMatrix& joint : pose) joint = rig::compose(map, joint);
  return pose;
}

geometry::TriMesh posed_skin(const MovingBody& moving, const Pose& pose) {
  std::vector<rig::Affine> skinning(pose.size());
  rig::skinning_matrices(moving.body.skeleton, pose, skinning);
  geometry::TriMesh skin = moving.body.mesh;
  rig::skin_linear(moving.body.mesh.positions, moving.body.weights, skinning, skin.positions);
  return skin;
}

binding::Poser make_poser(const MovingBody& moving) {
  auto poser = binding::Poser::make(moving.bound);
  REQUIRE(poser);
  return std::move(poser).value();
}

}  // namespace binding_test
