#include <bodice/engine/random.hpp>

#include "pose/pose.hpp"

namespace bodice::inline v0_1::synth {
namespace {

PoseAngles both(const ArmAngles& arm, const LegAngles& leg) {
  PoseAngles pose;
  pose.arm = {arm, arm};
  pose.leg = {leg, leg};
  return pose;
}

PoseAngles stride() {
  PoseAngles pose;
  pose.turn = 6.0;
  pose.arm[0] = {.raise = 20, .forward = -24, .elbow = 12};
  pose.arm[1] = {.raise = 20, .forward = 28, .elbow = 22};
  pose.leg[0] = {.flex = 28, .spread = 2, .knee = 6, .ankle = 4};
  pose.leg[1] = {.flex = -18, .spread = 2, .knee = 18, .ankle = -8};
  return pose;
}

PoseAngles run() {
  PoseAngles pose;
  pose.lean = 14.0;
  pose.nod = -8.0;
  pose.arm[0] = {.raise = 20, .forward = -45, .elbow = 85, .curl = 35};
  pose.arm[1] = {.raise = 20, .forward = 40, .elbow = 90, .curl = 35};
  pose.leg[0] = {.flex = 62, .spread = 3, .knee = 85};
  pose.leg[1] = {.flex = -22, .spread = 3, .knee = 35, .ankle = -25};
  return pose;
}

PoseAngles kick() {
  PoseAngles pose;
  pose.lean = -8.0;
  pose.arm[0] = {.raise = 60, .forward = -20, .elbow = 25};
  pose.arm[1] = {.raise = 50, .forward = 35, .elbow = 40};
  pose.leg[0] = {.flex = 82, .spread = 6, .knee = 8, .ankle = -15};
  pose.leg[1] = {.flex = -4, .spread = 4, .knee = 8, .ankle = 6};
  return pose;
}

PoseAngles squat() {
  PoseAngles pose = both({.raise = 20, .forward = 68, .elbow = 12},
                         {.flex = 104, .spread = 16, .twist = 14, .knee = 118, .ankle = 26});
  pose.lean = 24.0;
  pose.nod = -12.0;
  pose.pitch = 12.0;
  return pose;
}

PoseAngles random_angles(std::uint64_t seed) {
  engine::Random random(seed, 0x905E);
  PoseAngles pose;
  pose.yaw = random.uniform(-180, 180);
  pose.pitch = random.uniform(-20, 25);
  pose.roll = random.uniform(-12, 12);
  pose.lean = random.uniform(-12, 40);
  pose.bend = random.uniform(-18, 18);
  pose.turn = random.uniform(-28, 28);
  pose.nod = random.uniform(-20, 30);
  pose.look = random.uniform(-45, 45);
  for (ArmAngles& arm : pose.arm)
    arm = {.raise = random.uniform(15, 165),
           .forward = random.uniform(-35, 85),
           .twist = random.uniform(-40, 40),
           .elbow = random.uniform(0, 115),
           .wrist = random.uniform(-35, 45),
           .curl = random.uniform(0, 45)};
  for (LegAngles& leg : pose.leg) {
    leg = {.flex = random.uniform(-20, 95),
           .spread = random.uniform(0, 32),
           .twist = random.uniform(-10, 25),
           .knee = random.uniform(0, 110),
           .ankle = random.uniform(-25, 15)};
    if (leg.flex < 10.0) leg.knee = std::min(leg.knee, 70.0);
  }
  return pose;
}

}  // namespace

PoseAngles angles_of(Pose pose, std::uint64_t seed) {
  switch (pose) {
    case Pose::kA:
      return both({.raise = 45}, {.spread = 6});
    case Pose::kT:
      return both({.raise = 90, .elbow = 0}, {.spread = 5});
    case Pose::kArmsDown:
      return both({.raise = 10, .elbow = 8}, {.spread = 3});
    case Pose::kArmsUp:
      return both({.raise = 166, .elbow = 6}, {.spread = 3});
    case Pose::kStride:
      return stride();
    case Pose::kSit:
      return both({.raise = 20, .forward = 20, .elbow = 42}, {.flex = 86, .spread = 8, .knee = 88});
    case Pose::kSquat:
      return squat();
    case Pose::kRun:
      return run();
    case Pose::kKick:
      return kick();
    case Pose::kLying: {
      PoseAngles lying = both({.raise = 28, .elbow = 10}, {.spread = 9, .twist = 18, .ankle = -25});
      lying.pitch = -90.0;
      return lying;
    }
    case Pose::kHandstand: {
      PoseAngles up = both({.raise = 168, .elbow = 2, .wrist = -55, .curl = 0}, {.spread = 8, .ankle = -30});
      up.roll = 180.0;
      up.nod = -18.0;
      return up;
    }
    case Pose::kRandom:
      return random_angles(seed);
  }
  return {};
}

}  // namespace bodice::synth
