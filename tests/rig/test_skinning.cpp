#include <doctest/doctest.h>

#include <bodice/rig/rig.hpp>

#include "chains.hpp"

using namespace bodice::rig;
using rig_test::arm;
using rig_test::elbow_bent_90;

TEST_CASE("skinning: of two joints, the second bent by 90 degrees, points land where a hand computes") {
  const Rig rig = arm();
  std::vector<Affine> world(2), skinning(2);
  joint_matrices(rig.skeleton, elbow_bent_90(), 1.0, world);
  skinning_matrices(rig.skeleton, world, skinning);
  const std::vector<Vec3> rest = {{0.5, 0, 0}, {1.5, 0, 0}, {1.0, 0.1, 0}};
  std::vector<Vec3> posed(3);
  skin_linear(rest, rig.weights, skinning, posed);
  CHECK((posed[0] - Vec3(0.5, 0, 0)).norm() < 1e-12);  // the upper arm stays
  CHECK((posed[1] - Vec3(1, 0.5, 0)).norm() < 1e-12);  // the forearm points up
  // Half of each joint: the mean of (1, .1, 0) and the elbow's (1 - .1, 0, 0).
  CHECK((posed[2] - Vec3(0.95, 0.05, 0)).norm() < 1e-6);
}
