// An arm with an elbow, for cases of the C interface about colliders in a pose.
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include <bodice/binding/bind.hpp>
#include <bodice_test/shapes.hpp>

#include "capi/scene.hpp"

namespace capi_test {

using Joints = std::vector<bodice::proxy::JointMatrix>;  ///< joint space to world

/// An arm along y with an elbow in its middle: relief, bound to the two joints.
struct Arm {
  bodice::geometry::TriMesh skin = bodice_test::cylinder(0.05, 0.6, 24, 60);
  bodice::rig::Skeleton skeleton;
  bodice::rig::SkinWeights weights;

  Arm() {
    skeleton.joints.resize(2);
    skeleton.joints[0].name = "upperarm";
    skeleton.joints[1].name = "forearm";
    skeleton.joints[1].parent = 0;
    skeleton.joints[0].bind.col(3) = bodice_test::Vec3(0.0, -0.3, 0.0);
    weights.first.push_back(0);
    for (const bodice_test::Vec3& p : skin.positions) {
      const double lower = std::clamp(0.5 + p.y() / 0.1, 0.01, 0.99);
      weights.joint.insert(weights.joint.end(), {0, 1});
      weights.weight.insert(weights.weight.end(),
                            {static_cast<float>(1.0 - lower), static_cast<float>(lower)});
      weights.first.push_back(static_cast<std::uint32_t>(weights.joint.size()));
    }
  }

  bodice::proxy::BodyProxy bound() const {
    std::vector<bodice_test::Ellipsoid> shapes(9);
    for (std::size_t k = 0; k < shapes.size(); ++k) {
      shapes[k].center.y() = 0.065 * (static_cast<double>(k) - 4.0);
      shapes[k].radii = bodice_test::Vec3(0.05, 0.07, 0.05);
    }
    const auto rest =
        bodice_test::proxy_of(bodice_test::with_relief(bodice_test::data_of(shapes), 12, 0.002, 3));
    auto made = bodice::binding::bind({}, rest, {skin, skeleton, weights});
    REQUIRE_MESSAGE(made, made.error().sentence());
    return std::move(made).value();
  }

  /// The elbow bent, all of it moved; rounded to floats.
  Joints bent() const {
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.1, bodice_test::Vec3::UnitX()).toRotationMatrix();
    Joints joints = {skeleton.joints[0].bind, skeleton.joints[1].bind};
    joints[1].leftCols<3>() = turn;
    for (auto& joint : joints) {
      joint.col(3) += bodice_test::Vec3(0.2, 0.1, -0.1);
      joint = joint.cast<float>().cast<double>();
    }
    return joints;
  }
};

}  // namespace capi_test
