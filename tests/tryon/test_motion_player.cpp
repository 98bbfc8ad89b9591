// The joints of a body over time: the ramp to its clip, the clip, and points that are attached to its skin.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include <bodice/tryon/motion.hpp>

using namespace bodice;
using geometry::Vec3;

namespace {

constexpr double kTurn_rad = 0.5 * std::numbers::pi;

/// Two joints on the y axis, the second one a meter up; a clip turns the second about z by a quarter in a
/// second.
tryon::BodyMotion elbow(std::size_t vertices) {
  tryon::BodyMotion motion;
  auto& joints = motion.rig.skeleton.joints;
  joints.resize(2);
  joints[0].name = "upper";
  joints[1].name = "lower";
  joints[1].parent = 0;
  joints[1].local.translation = Vec3::UnitY();
  joints[1].bind = rig::affine(geometry::Mat3::Identity(), Vec3::UnitY());
  rig::Track track{.joint = 1};
  track.rotation.time_s = {0.0, 1.0};
  track.rotation.value = {Eigen::Quaterniond(Eigen::AngleAxisd(0.2, Vec3::UnitZ())),
                          Eigen::Quaterniond(Eigen::AngleAxisd(kTurn_rad, Vec3::UnitZ()))};
  motion.clip = {.name = "bend", .duration_s = 1.0, .tracks = {track}};
  motion.rig.weights.first.push_back(0);
  for (std::size_t v = 0; v < vertices; ++v) {
    motion.rig.weights.joint.push_back(v % 2);
    motion.rig.weights.weight.push_back(1.0f);
    motion.rig.weights.first.push_back(static_cast<std::uint32_t>(v + 1));
  }
  return motion;
}

double turn_of(const rig::Affine& world) {
  return std::atan2(world(1, 0), world(0, 0));
}

}  // namespace

TEST_CASE("a ramp leads from the bind pose to the clip's first frame, and then the clip plays") {
  const tryon::BodyMotion motion = elbow(2);
  tryon::MotionPlayer player(motion, 0.5);
  std::vector<rig::Affine> world(2);
  player.joints(-0.5, world);
  CHECK(std::abs(turn_of(world[1])) < 1e-12);  // the bind pose
  player.joints(-0.25, world);
  // Halfway, between the bind pose and a tenth of a second before the clip.
  CHECK(turn_of(world[1]) == doctest::Approx(0.5 * (0.2 - 0.1 * (kTurn_rad - 0.2))).epsilon(0.03));
  player.joints(0.0, world);
  CHECK(turn_of(world[1]) == doctest::Approx(0.2));
  player.joints(1.0, world);
  CHECK(turn_of(world[1]) == doctest::Approx(kTurn_rad));
  player.joints(9.0, world);
  CHECK(turn_of(world[1]) == doctest::Approx(kTurn_rad));
  tryon::MotionPlayer looping(motion, 0.5, rig::Playback::kLoop);
  looping.joints(2.0, world);
  CHECK(turn_of(world[1]) == doctest::Approx(0.2));
}

TEST_CASE("a ramp ends with the velocity of the clip, and turns no joint farther than it must for that") {
  const tryon::BodyMotion motion = elbow(2);
  tryon::MotionPlayer player(motion, 0.5);
  std::vector<rig::Affine> world(2);
  constexpr double kStep_s = 1e-4;
  const double speed_rad_s = kTurn_rad - 0.2;  // The clip lasts a second.
  player.joints(-kStep_s, world);
  const double before = turn_of(world[1]);
  player.joints(0.0, world);
  CHECK((turn_of(world[1]) - before) / kStep_s == doctest::Approx(speed_rad_s).epsilon(0.01));
  for (int step = 0; step <= 100; ++step) {
    player.joints(-0.005 * step, world);
    // From the bind pose to the clip's first turn, no overshoot.
    CHECK(std::abs(turn_of(world[1])) <= 0.2 + 1e-9);
  }
}

TEST_CASE("a ramp does not jump where the clip that it leads to starts over") {
  tryon::BodyMotion motion = elbow(2);
  motion.clip.tracks[0].rotation.time_s = {0.0, 0.05};
  motion.clip.duration_s = 0.05;
  tryon::MotionPlayer player(motion, 0.5, rig::Playback::kLoop);
  std::vector<rig::Affine> world(2);
  player.joints(-0.5, world);
  double before = turn_of(world[1]), longest = 0.0;
  for (int step = 499; step >= 0; --step) {
    player.joints(-1e-3 * step, world);
    longest = std::max(longest, std::abs(turn_of(world[1]) - before));
    before = turn_of(world[1]);
  }
  CHECK(longest < 0.05);  // The clip turns by 0.027 in a millisecond, and by 1.4 where it starts over.
}

TEST_CASE("the suggested ramp takes the time of the skin's path at the speed of a walking hand, or none") {
  std::vector<Vec3> skin = {{0.0, 0.0, 0.0}, {1.0, 1.0, 0.0}};  // the second is a meter from its joint
  tryon::BodyMotion motion = elbow(2);
  CHECK(tryon::suggested_ramp_s({}, motion, skin) == doctest::Approx(0.25));  // 0.2 m at 1 m/s: the least
  motion.clip.tracks[0].rotation.value[0] = Eigen::Quaterniond(Eigen::AngleAxisd(1.0, Vec3::UnitZ()));
  CHECK(tryon::suggested_ramp_s({}, motion, skin) == doctest::Approx(2.0 * std::sin(0.5)));
  motion.clip.tracks[0].rotation.value[0] = Eigen::Quaterniond::Identity();
  CHECK(tryon::suggested_ramp_s({}, motion, skin) == 0.0);
}

TEST_CASE("a loop is closed by a seam in which the skin is about as fast as in the clip") {
  const std::vector<Vec3> skin = {{0.0, 0.0, 0.0}, {1.0, 1.0, 0.0}};  // the second is a meter from its joint
  tryon::BodyMotion motion = elbow(2);
  const double arc_rad = kTurn_rad - 0.2;
  const tryon::BodyMotion closed = tryon::closed_loop({}, motion, skin);
  // The vertex moves at arc_rad m/s in the clip, and its chord back is 2 sin(arc / 2) m.
  CHECK(closed.clip.duration_s ==
        doctest::Approx(1.0 + 2.0 * std::sin(0.5 * arc_rad) / arc_rad).epsilon(1e-3));
  tryon::MotionPlayer player(closed, 0.0, rig::Playback::kLoop);
  std::vector<rig::Affine> world(2);
  player.joints(0.0, world);
  double before = turn_of(world[1]), fastest = 0.0;
  for (int step = 1; step <= 4000; ++step) {
    player.joints(1e-3 * step, world);
    fastest = std::max(fastest, std::abs(turn_of(world[1]) - before) / 1e-3);
    before = turn_of(world[1]);
  }
  CHECK(fastest < 2.5 * arc_rad);  // a jump back would be a thousand times as fast

  motion.clip.tracks[0].rotation.value[1] = motion.clip.tracks[0].rotation.value[0];
  CHECK(tryon::closed_loop({}, motion, skin).clip.duration_s == 1.0);  // its end meets its start
  motion.clip.duration_s = 0.0;
  CHECK(tryon::closed_loop({}, motion, skin).clip.duration_s == 0.0);
}

TEST_CASE("a point that is attached to the skin moves as the skin below it") {
  const geometry::TriMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}, {{0, 2, 1}}};
  const geometry::MeshDistance distance({}, mesh);
  const tryon::BodyMotion motion = elbow(3);  // vertices 0 and 2 belong to joint 0, vertex 1 to joint 1
  const std::vector<Vec3> points = {{1.0, 0.05, 0.0}, {0.0, 0.05, 0.0}, {0.25, 0.05, 0.25}};
  const rig::SkinWeights weights = tryon::attach_to_skin(mesh, distance, motion.rig.weights, points);
  REQUIRE(weights.vertices() == 3);
  CHECK(weights.joint[weights.first[0]] == 1);
  CHECK(weights.first[1] - weights.first[0] == 1);
  CHECK(weights.joint[weights.first[1]] == 0);
  REQUIRE(weights.first[3] - weights.first[2] == 2);
  CHECK(weights.weight[weights.first[2]] == doctest::Approx(0.75));
  CHECK(weights.weight[weights.first[2] + 1] == doctest::Approx(0.25));
}

TEST_CASE("a motion with weights of another skin is refused, and both numbers are named") {
  const auto checked = tryon::check(elbow(2), 3);
  REQUIRE(!checked.ok());
  CHECK(checked.error().sentence().find("2 vertices, but the skin has 3") != std::string::npos);
}
