#include <bodice/rigging/motion.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <doctest/doctest.h>
#include <bodice/body/joint.hpp>
#include "posed.hpp"

namespace {

using namespace bodice;
using posed::joints_at;
using posed::position;
using posed::Vec3;
using rigging::Motion;
using synth::Pose;

constexpr double kDegrees = 180.0 / std::numbers::pi;

Motion motion(int i) {
  return static_cast<Motion>(i);
}

double angle_deg(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b)) * kDegrees;
}

std::vector<double> times(const rig::Clip& clip, int count) {
  std::vector<double> all;
  for (int k = 0; k <= count; ++k) all.push_back(clip.duration_s * k / count);
  return all;
}

TEST_CASE("a motion's name leads back to it, and no other name to any") {
  for (int i = 0; i < rigging::kMotionCount; ++i)
    CHECK(rigging::motion_from_name(name(motion(i))) == motion(i));
  CHECK_FALSE(rigging::motion_from_name("fly").has_value());
}

TEST_CASE("every motion is a valid clip in which no bone changes its length") {
  const synth::Body body = posed::made_body({.stature_m = 1.7});
  for (int i = 0; i < rigging::kMotionCount; ++i) {
    CAPTURE(name(motion(i)));
    const rig::Clip clip = posed::made_clip(body.skeleton, motion(i));
    const auto valid = rig::validate(clip, body.skeleton);
    REQUIRE_MESSAGE(valid.ok(), (valid.ok() ? "" : valid.error().sentence()));
    CHECK(clip.name == name(motion(i)));
    double worst = 0.0;
    for (const double t : times(clip, 37)) {
      const auto world = joints_at(body.skeleton, clip, t);
      for (std::size_t j = 0; j < world.size(); ++j) {
        const auto p = body.skeleton.joints[j].parent;
        if (p < 0) continue;
        const Vec3 bound = body.skeleton.joints[j].bind.col(3) - body.skeleton.joints[p].bind.col(3);
        worst = std::max(worst, std::abs((world[j].col(3) - world[p].col(3)).norm() - bound.norm()));
      }
    }
    CHECK(worst < 1e-9);
  }
}

TEST_CASE("a cyclic motion ends with the joints where it began") {
  const synth::Body body = posed::made_body({});
  for (int i = 0; i < rigging::kMotionCount; ++i) {
    if (!is_cyclic(motion(i))) continue;
    CAPTURE(name(motion(i)));
    const rig::Clip clip = posed::made_clip(body.skeleton, motion(i));
    const auto first = joints_at(body.skeleton, clip, 0.0);
    const auto last = joints_at(body.skeleton, clip, clip.duration_s);
    for (std::size_t j = 0; j < first.size(); ++j) CHECK((first[j] - last[j]).norm() < 1e-9);
  }
}

TEST_CASE("no joint jumps between keys: its speed stays within a person's, spinning included") {
  constexpr double kFastest_mps = 12.0;  // a runner's swinging foot, on a treadmill, at 2.7 m/s
  const synth::Body body = posed::made_body({});
  for (int i = 0; i < rigging::kMotionCount; ++i) {
    CAPTURE(name(motion(i)));
    const rig::Clip clip = posed::made_clip(body.skeleton, motion(i));
    const double dt = 1.0 / 240.0;
    double fastest = 0.0;
    for (double t = 0.0; t + dt <= clip.duration_s; t += dt) {
      const auto a = joints_at(body.skeleton, clip, t), b = joints_at(body.skeleton, clip, t + dt);
      for (std::size_t j = 0; j < a.size(); ++j)
        fastest = std::max(fastest, (b[j].col(3) - a[j].col(3)).norm() / dt);
    }
    CHECK(fastest < kFastest_mps);
    CHECK(fastest > 0.3);
  }
}

struct Named {
  const char* name;
  synth::BodyOptions options;
};

const Named kBodies[] = {{"average", {}},
                         {"tall and thin", {.sex = body::Sex::kMale, .stature_m = 2.0, .mass_kg = 72.0}},
                         {"heavy", {.stature_m = 1.6, .mass_kg = 105.0, .seed = 3}},
                         {"child", {.stature_m = 0.95, .mass_kg = 15.0, .childhood = 0.9}}};

TEST_CASE("soles rest on the floor and do not sink, on any build") {
  // Fractions of the stature: the made skin's own soles are rounded by this much, and linear blending folds
  // the ball.
  constexpr double kSink = 0.008, kFloat = 0.006;
  for (const auto& [label, options] : kBodies) {
    const synth::Body body = posed::made_body(options);
    for (int i = 0; i < rigging::kMotionCount; ++i) {
      if (motion(i) == Motion::kRun) continue;  // it has a phase of flight
      CAPTURE(label);
      CAPTURE(name(motion(i)));
      const rig::Clip clip = posed::made_clip(body.skeleton, motion(i));
      for (const double t : times(clip, 40)) {
        double lowest = 1e9;
        for (const Vec3& p : posed::skin_at(body, clip, t)) lowest = std::min(lowest, p.y());
        CAPTURE(t);
        CHECK(lowest > -kSink * body.stature_m);
        CHECK(lowest < kFloat * body.stature_m);
      }
    }
  }
}

TEST_CASE("a floor that is given is where soles rest, wherever the bind pose has them") {
  const synth::Body body = posed::made_body({.pose = Pose::kSit});
  for (const double floor_m : {-0.4, 0.7}) {
    const rig::Clip clip = posed::made_clip(body.skeleton, Motion::kWalk, {.floor_m = floor_m});
    for (const double t : times(clip, 10)) {
      double lowest = 1e9;
      for (const Vec3& p : posed::skin_at(body, clip, t)) lowest = std::min(lowest, p.y());
      CHECK(std::abs(lowest - floor_m) < 0.008 * body.stature_m);
    }
  }
}

/// How fast skin within `within_m` of the floor moves over it, m/s: mean over all moments and vertices of the
/// feet.
double slip(const synth::Body& body, const rig::Clip& clip, double within_m) {
  constexpr double dt = 1.0 / 120.0;
  double sum = 0.0;
  std::size_t count = 0;
  std::vector<std::size_t> soles;
  for (const char* joint : {"foot_l", "foot_r"})
    for (const std::size_t v : posed::vertices_of(body, joint)) soles.push_back(v);
  for (double t = 0.0; t + dt <= clip.duration_s; t += dt) {
    const auto a = posed::skin_at(body, clip, t), b = posed::skin_at(body, clip, t + dt);
    for (const std::size_t v : soles) {
      if (a[v].y() > within_m || b[v].y() > within_m) continue;
      Vec3 step = b[v] - a[v];
      step.y() = 0.0;
      sum += step.norm() / dt;
      ++count;
    }
  }
  REQUIRE(count > 500);  // a run touches the floor for a third of its time
  return sum / static_cast<double>(count);
}

TEST_CASE("feet on the floor stay where they were set down") {
  constexpr double kNearFloor_m = 0.004, kSlip_mps = 0.03;
  const synth::Body body = posed::made_body({.vertices = 4000});
  for (const Motion m :
       {Motion::kTurn, Motion::kReach, Motion::kSit, Motion::kSquat, Motion::kArmsUp, Motion::kDance}) {
    CAPTURE(name(m));
    CHECK(slip(body, posed::made_clip(body.skeleton, m), kNearFloor_m) < kSlip_mps);
  }
  for (const Motion m : {Motion::kWalk, Motion::kRun}) {
    CAPTURE(name(m));
    const double speed = *rigging::travel_speed_mps(body.skeleton, m);
    CHECK(slip(body, posed::made_clip(body.skeleton, m, {.travel = true}), kNearFloor_m) < 0.04 * speed);
    CHECK(slip(body, posed::made_clip(body.skeleton, m), kNearFloor_m) > 0.9 * speed);  // as on a treadmill
  }
}

TEST_CASE("a walk travels at a walking speed, a run at a running one, and both alternate arms and legs") {
  const synth::Body body = posed::made_body({.stature_m = 1.7});
  const double walking = *rigging::travel_speed_mps(body.skeleton, Motion::kWalk);
  const double running = *rigging::travel_speed_mps(body.skeleton, Motion::kRun);
  CHECK((walking > 0.9 && walking < 1.5));
  CHECK((running > 2.2 && running < 4.0));
  CHECK(*rigging::travel_speed_mps(body.skeleton, Motion::kSit) == 0.0);
  for (const Motion m : {Motion::kWalk, Motion::kRun}) {
    const rig::Clip clip = posed::made_clip(body.skeleton, m);
    double arms_and_legs = 0.0;
    for (const double t : times(clip, 60)) {
      const auto world = joints_at(body.skeleton, clip, t);
      const auto ahead = [&](const char* l, const char* r) {
        return position(body.skeleton, world, l).z() - position(body.skeleton, world, r).z();
      };
      arms_and_legs += ahead("hand_l", "hand_r") * ahead("foot_l", "foot_r");
    }
    CHECK(arms_and_legs < 0.0);
  }
}

TEST_CASE("a seat has hips and knees at right angles, the trunk upright, and feet where they stood") {
  for (const auto& [label, options] : kBodies) {
    CAPTURE(label);
    const synth::Body body = posed::made_body(options);
    const rig::Clip clip = posed::made_clip(body.skeleton, Motion::kSit);
    const auto before = joints_at(body.skeleton, clip, 0.0);
    const auto seated = joints_at(body.skeleton, clip, clip.duration_s);
    const auto at = [&](const char* joint) { return position(body.skeleton, seated, joint); };
    for (const char* side : {"_l", "_r"}) {
      const std::string s = side;
      const Vec3 hip = at(("thigh" + s).c_str()), knee = at(("calf" + s).c_str()),
                 ankle = at(("foot" + s).c_str());
      CHECK(std::abs(angle_deg(hip - knee, ankle - knee) - 90.0) < 6.0);
      CHECK(std::abs(angle_deg(at("neck") - at("pelvis"), knee - hip) - 90.0) < 10.0);
      CHECK((ankle - position(body.skeleton, before, "foot" + s)).norm() < 1e-6);
    }
    CHECK(angle_deg(at("neck") - at("pelvis"), Vec3::UnitY()) < 6.0);
  }
}

/// Degrees about the upright axis from one frame to the next, to the left.
double heading_step(const rig::Affine& a, const rig::Affine& b) {
  const auto heading = [](const rig::Affine& m) { return std::atan2(m(0, 2), m(2, 2)) * kDegrees; };
  double step = heading(b) - heading(a);
  while (step > 180.0) step -= 360.0;
  while (step < -180.0) step += 360.0;
  return step;
}

TEST_CASE("a turn goes once around, a spin at 720 degrees a second") {
  const synth::Body body = posed::made_body({});
  for (const Motion m : {Motion::kTurn, Motion::kSpin}) {
    const rig::Clip clip = posed::made_clip(body.skeleton, m);
    double around = 0.0, fastest = 0.0;
    auto last = joints_at(body.skeleton, clip, 0.0);
    constexpr double dt = 1.0 / 200.0;
    for (int k = 1; k <= std::lround(clip.duration_s / dt); ++k) {
      const auto next = joints_at(body.skeleton, clip, k * dt);
      const double step = heading_step(last[0], next[0]);
      around += step;
      fastest = std::max(fastest, step / dt);
      last = next;
    }
    CHECK(std::abs(around - (m == Motion::kTurn ? 360.0 : 720.0)) < 1e-3);
    if (m == Motion::kSpin) CHECK(std::abs(fastest - 720.0) < 1.0);
  }
}

TEST_CASE("raised arms end above the head, a reach ends above it on one side alone") {
  const synth::Body body = posed::made_body({});
  const auto hands = [&](Motion m, double share) {
    const rig::Clip clip = posed::made_clip(body.skeleton, m);
    const auto world = joints_at(body.skeleton, clip, share * clip.duration_s);
    const double head = position(body.skeleton, world, "head").y();
    return std::pair(position(body.skeleton, world, "hand_l").y() - head,
                     position(body.skeleton, world, "hand_r").y() - head);
  };
  const auto [left, right] = hands(Motion::kArmsUp, 0.5);
  CHECK((left > 0.1 && right > 0.1));
  const auto [low, high] = hands(Motion::kReach, 0.32);
  CHECK((low < -0.3 && high > 0.1));
}

TEST_CASE("a motion does not depend on the pose in which the skin is bound") {
  const synth::BodyOptions standing{.mass_kg = 70.0, .seed = 5};
  const synth::Body upright = posed::made_body(standing);
  for (const Pose pose : {Pose::kT, Pose::kArmsUp, Pose::kStride, Pose::kSit, Pose::kLying, Pose::kRandom}) {
    CAPTURE(static_cast<int>(pose));
    synth::BodyOptions options = standing;
    options.pose = pose;
    const synth::Body other = posed::made_body(options);
    const rig::Clip one = posed::made_clip(upright.skeleton, Motion::kWalk);
    const rig::Clip two = posed::made_clip(other.skeleton, Motion::kWalk);
    const auto a = joints_at(upright.skeleton, one, 0.3), b = joints_at(other.skeleton, two, 0.3);
    double worst = 0.0;
    for (int i = 0; i < body::kJointCount; ++i)
      for (int k = 0; k < i; ++k) {
        const auto p = rig::find_joint(upright.skeleton, body::kJointNames[i]);
        const auto q = rig::find_joint(upright.skeleton, body::kJointNames[k]);
        if (!p || !q) continue;  // the made body has no middle spine joint
        worst = std::max(
            worst, std::abs((a[*p].col(3) - a[*q].col(3)).norm() - (b[*p].col(3) - b[*q].col(3)).norm()));
      }
    CHECK(worst < 1e-6);
  }
}

TEST_CASE("a skeleton without the common joints is refused by the name of what it lacks") {
  rig::Skeleton skeleton = posed::made_body({}).skeleton;
  skeleton.joints[*rig::find_joint(skeleton, "calf_r")].name = "shin";
  const auto clip = rigging::make_clip(skeleton, Motion::kWalk);
  REQUIRE_FALSE(clip.ok());
  CHECK(clip.error().code == engine::ErrorCode::kInvalidArgument);
  CHECK(clip.error().message.find("calf_r") != std::string::npos);
  CHECK_FALSE(clip.error().remedy.empty());
  skeleton = posed::made_body({}).skeleton;
  skeleton.joints[*rig::find_joint(skeleton, "forearm_l")].parent = 0;
  const auto moved = rigging::make_clip(skeleton, Motion::kWalk);
  REQUIRE_FALSE(moved.ok());
  CHECK(moved.error().message.find("forearm_l") != std::string::npos);
}

}  // namespace
