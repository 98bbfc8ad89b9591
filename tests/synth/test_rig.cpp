#include <bodice/synth/body.hpp>

#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>
#include <bodice/body/joint.hpp>
#include <bodice/rig/rig.hpp>

#include "made_body.hpp"

namespace {

using namespace bodice;
using bodice_test::made;
using geometry::Vec3;
using synth::Pose;

/// The weight of one vertex for all joints with this ending of their name.
float weight_of(const synth::Body& body, std::size_t v, std::string_view end) {
  float sum = 0.0f;
  for (auto k = body.weights.first[v]; k < body.weights.first[v + 1]; ++k)
    if (body.skeleton.joints[body.weights.joint[k]].name.ends_with(end)) sum += body.weights.weight[k];
  return sum;
}

TEST_CASE("a made body's rig is valid, with the common joints at the true joints, in every pose") {
  for (int p = 0; p <= static_cast<int>(Pose::kRandom); ++p) {
    CAPTURE(p);
    const synth::Body body = made({.pose = static_cast<Pose>(p), .vertices = 1500, .seed = 9});
    const auto valid = rig::validate(body.skeleton);
    REQUIRE_MESSAGE(valid.ok(), (valid.ok() ? "" : valid.error().sentence()));
    REQUIRE(body.skeleton.joints.size() == body.joints.size());
    for (std::size_t j = 0; j < body.joints.size(); ++j)
      CHECK((body.skeleton.joints[j].bind.col(3) - body.joints[j].position).norm() < 1e-12);
    for (int i = 0; i < body::kJointCount; ++i)
      if (static_cast<body::JointId>(i) != body::JointId::kSpineMiddle)
        CHECK(rig::find_joint(body.skeleton, body::kJointNames[i]).has_value());
    std::vector<rig::Affine> world(body.skeleton.joints.size());
    rig::rest_matrices(body.skeleton, world);  // the rest pose is the bind pose
    for (std::size_t j = 0; j < world.size(); ++j)
      CHECK((world[j] - body.skeleton.joints[j].bind).norm() < 1e-9);
  }
}

TEST_CASE("a made body's weights are positive and sum to 1, and no limb moves the other side's") {
  for (const Pose pose : {Pose::kA, Pose::kSit, Pose::kArmsDown}) {
    const synth::Body body = made({.mass_kg = 95.0, .pose = pose});
    REQUIRE(body.weights.vertices() == body.mesh.positions.size());
    std::size_t limbs = 0;
    for (std::size_t v = 0; v < body.part.size(); ++v) {
      float sum = 0.0f, least = 1.0f;
      for (auto k = body.weights.first[v]; k < body.weights.first[v + 1]; ++k) {
        sum += body.weights.weight[k];
        least = std::min(least, body.weights.weight[k]);
      }
      CHECK(std::abs(sum - 1.0f) < 1e-5f);
      CHECK(least > 0.0f);
      if (body.part[v] < body::Part::kUpperArmL || body.part[v] == body::Part::kThighL ||
          body.part[v] == body::Part::kThighR)
        continue;  // thighs meet at the crotch
      ++limbs;
      const bool left = (static_cast<int>(body.part[v]) - static_cast<int>(body::Part::kUpperArmL)) % 2 == 0;
      CHECK(weight_of(body, v, left ? "_r" : "_l") == 0.0f);
    }
    CHECK(limbs > 1000);
  }
}

TEST_CASE("skin that one joint carries alone moves from one made pose to another as that joint does") {
  const synth::Body a = made({.pose = Pose::kA, .seed = 4});
  for (const Pose pose : {Pose::kRun, Pose::kSit, Pose::kArmsUp, Pose::kRandom}) {
    CAPTURE(static_cast<int>(pose));
    const synth::Body b = made({.pose = pose, .seed = 4});
    REQUIRE(a.mesh.positions.size() == b.mesh.positions.size());
    std::size_t alone = 0;
    double worst = 0.0;
    for (std::size_t v = 0; v < a.mesh.positions.size(); ++v) {
      const auto k = a.weights.first[v];
      if (a.weights.first[v + 1] != k + 1) continue;
      const auto j = a.weights.joint[k];
      const rig::Affine motion =
          rig::compose(b.skeleton.joints[j].bind, rig::inverse(a.skeleton.joints[j].bind));
      worst = std::max(worst, (rig::apply(motion, a.mesh.positions[v]) - b.mesh.positions[v]).norm());
      ++alone;
    }
    CHECK(alone > 1000);
    CHECK(worst < 1e-3);  // weights below a ten-thousandth are left out
  }
}

TEST_CASE("upright with hanging arms and straight legs, every joint's axes are nearly the body's") {
  const synth::Body body = made({.pose = Pose::kArmsDown});
  for (const rig::Joint& joint : body.skeleton.joints) {
    if (joint.name.starts_with("finger") || joint.name.starts_with("thumb")) continue;  // they are curled
    CAPTURE(joint.name);
    const Eigen::AngleAxisd turn(Eigen::Quaterniond(rig::linear_of(joint.bind)));
    CHECK(turn.angle() < 0.35);  // the arms are raised by 10 degrees and bent by 8
  }
}

}  // namespace
