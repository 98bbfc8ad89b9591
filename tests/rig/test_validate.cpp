// Each flaw of a rig gets one sentence that names the joint, and one remedy.
#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <limits>

#include <bodice/rig/rig.hpp>

#include "chains.hpp"

using namespace bodice::rig;
using rig_test::arm;
using rig_test::elbow_bent_90;

namespace {

/// The rig of an arm with a clip, changed by `spoil`, is refused with words of its flaw.
void check_refused(const char* words, const std::function<void(Rig&)>& spoil) {
  CAPTURE(words);
  Rig rig = arm();
  rig.clips.push_back(elbow_bent_90());
  REQUIRE(mend(rig, 3).ok());
  spoil(rig);
  const auto mended = mend(rig, 3);
  REQUIRE(!mended.ok());
  CHECK(mended.error().code == bodice::engine::ErrorCode::kUnusableGeometry);
  CHECK(mended.error().message.find(words) != std::string::npos);
  CHECK(mended.error().message.ends_with('.'));
  CHECK(!mended.error().remedy.empty());
}

const double kNaN = std::numeric_limits<double>::quiet_NaN();

}  // namespace

TEST_CASE("rig: a skeleton that cannot be posed is refused, and the joint named") {
  check_refused("Joint 1 ('elbow') has a local transform that is not finite",
                [](Rig& rig) { rig.skeleton.joints[1].local.translation.y() = kNaN; });
  check_refused("Joint 1 ('elbow') is scaled to zero",
                [](Rig& rig) { rig.skeleton.joints[1].local.scale.z() = 0.0; });
  check_refused("Joint 0 ('shoulder') has no inverse bind matrix",
                [](Rig& rig) { rig.skeleton.joints[0].bind.setZero(); });
  check_refused("Joint 0 ('shoulder') has no inverse bind matrix",
                [](Rig& rig) { rig.skeleton.joints[0].bind(1, 3) = kNaN; });
  check_refused("Joint 1 ('elbow') has a rotation of length zero",
                [](Rig& rig) { rig.skeleton.joints[1].local.rotation.coeffs().setZero(); });
  check_refused("Joint 0 ('shoulder') stands before its parent",
                [](Rig& rig) { rig.skeleton.joints[0].parent = 1; });
  check_refused("Joint 1 ('elbow') has the parent 9", [](Rig& rig) { rig.skeleton.joints[1].parent = 9; });
}

TEST_CASE("rig: skin weights that cannot be mended are refused, and the vertex named") {
  check_refused("Vertex 2 is bound to joint 7", [](Rig& rig) { rig.weights.joint[3] = 7; });
  check_refused("Vertex 0 has a weight for Joint 0 ('shoulder') that is negative or not finite",
                [](Rig& rig) { rig.weights.weight[0] = -0.1f; });
  check_refused("Vertex 1 has a weight for Joint 1 ('elbow') that is negative or not finite",
                [](Rig& rig) { rig.weights.weight[1] = std::numeric_limits<float>::quiet_NaN(); });
  check_refused("Vertex 1 of the skin has no weight", [](Rig& rig) { rig.weights.weight[1] = 0.0f; });
  check_refused("its weights are for 2", [](Rig& rig) { rig.weights.first.pop_back(); });
  check_refused("counts do not add up", [](Rig& rig) { rig.weights.first[1] = 4; });
}

TEST_CASE("rig: a clip that cannot be played is refused, and clip and joint named") {
  check_refused("Clip 'bend' moves joint 9", [](Rig& rig) { rig.clips[0].tracks[0].joint = 9; });
  check_refused("'elbow') has a rotation key that is not finite",
                [](Rig& rig) { rig.clips[0].tracks[0].rotation.value[1].x() = kNaN; });
  check_refused("'elbow') has a rotation key that is not a unit quaternion",
                [](Rig& rig) { rig.clips[0].tracks[0].rotation.value[1].coeffs() *= 3.0; });
  check_refused("'elbow') has rotation keys with times",
                [](Rig& rig) { rig.clips[0].tracks[0].rotation.time_s[1] = -1.0; });
  check_refused("'elbow') has rotation keys without a value each",
                [](Rig& rig) { rig.clips[0].tracks[0].rotation.value.pop_back(); });
  check_refused("'elbow') has a scale key of zero", [](Rig& rig) {
    rig.clips[0].tracks[0].scale = {Interpolation::kLinear, {0.0}, {Vec3(1, 0, 1)}};
  });
  check_refused("tracks out of order or twice",
                [](Rig& rig) { rig.clips[0].tracks.push_back(rig.clips[0].tracks[0]); });
  check_refused("duration", [](Rig& rig) { rig.clips[0].duration_s = kNaN; });
}

TEST_CASE("rig: sums of weights are mended, large differences reported, joints named twice merged") {
  Rig rig = arm();
  rig.weights = {{0, 2, 3, 6}, {0, 1, 1, 1, 0, 1}, {0.5f, 0.0f, 0.996f, 0.25f, 0.5f, 0.25f}};
  const auto mended = mend(rig, 3);
  REQUIRE(mended.ok());
  REQUIRE(mended->size() == 1);
  CHECK(mended->front().code == "weights-normalized");
  CHECK(mended->front().message.find("1 of 3 vertices") != std::string::npos);  // .996 may be rounding
  CHECK(rig.weights.first == std::vector<std::uint32_t>{0, 1, 2, 4});
  CHECK(rig.weights.joint == std::vector<std::uint16_t>{0, 1, 1, 0});
  CHECK(rig.weights.weight == std::vector<float>{1.0f, 1.0f, 0.5f, 0.5f});
}

TEST_CASE("rig: joints in any order are put parents first, with weights and clips; circles are refused") {
  Rig rig = arm();
  rig.clips.push_back(elbow_bent_90());
  Rig turned = rig;
  std::swap(turned.skeleton.joints[0], turned.skeleton.joints[1]);
  turned.skeleton.joints[0].parent = 1;
  for (std::uint16_t& joint : turned.weights.joint) joint = static_cast<std::uint16_t>(1 - joint);
  turned.clips[0].tracks[0].joint = 0;
  REQUIRE(put_parents_first(turned).ok());
  CHECK(turned.skeleton.joints[1].name == "elbow");
  CHECK(turned.skeleton.joints[1].parent == 0);
  CHECK(turned.weights.joint == rig.weights.joint);
  CHECK(turned.clips[0].tracks[0].joint == 1);
  turned.skeleton.joints[0].parent = 1;
  const auto circle = put_parents_first(turned);
  REQUIRE(!circle.ok());
  CHECK(circle.error().message.find("is its own ancestor") != std::string::npos);
}

TEST_CASE("rig: no joints, 1,000 joints in one chain and too many are posed or refused") {
  Rig none;
  CHECK(mend(none, 0).ok() == false);  // a table of weights has one entry more than vertices
  none.weights.first = {0};
  CHECK(mend(none, 0).ok());
  joint_matrices(none.skeleton, Clip{}, 0.0, {});
  Skeleton chain;
  for (std::int32_t j = 0; j < 1000; ++j) {
    chain.joints.emplace_back();
    chain.joints.back().parent = j - 1;
    chain.joints.back().local.translation = Vec3(0, 0.01, 0);
  }
  CHECK(validate(chain).ok());
  std::vector<Affine> world(1000);
  rest_matrices(chain, world);
  CHECK(world.back().col(3).y() == doctest::Approx(10.0).epsilon(1e-12));
  chain.joints.resize(kMaxJoints + 1);
  CHECK(!validate(chain).ok());
}
