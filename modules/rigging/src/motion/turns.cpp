// The motions turn (once around, in steps) and spin (twice around, on both soles).
#include <cmath>
#include <numbers>

#include "motion/motions.hpp"
#include "posture/curve.hpp"

namespace bodice::inline v0_1::rigging {
namespace {

constexpr int kSteps = 6;        // of each leg, once around
constexpr double kSwing = 0.42;  // share of a step's time in which the leg is in the air

double smooth(double s) {
  return s * s * (3.0 - 2.0 * s);
}

/// A foot that turns by steps: in each step it is lifted, goes on by one step's angle, and then stays.
FootPosture stepping_foot(double steps, const Build& build, int side) {
  const double sign = side == 0 ? 1.0 : -1.0, whole = std::floor(steps), part = steps - whole;
  const double moved = part < kSwing ? smooth(part / kSwing) : 1.0;
  const double angle = 360.0 / kSteps * (whole + moved - 0.5 - 0.5 * kSwing);
  const double lift = part < kSwing ? std::sin(std::numbers::pi * part / kSwing) : 0.0;
  const double radians = angle * std::numbers::pi / 180.0;
  const double out = sign * build.hip_half_width;
  FootPosture foot;
  foot.ground = {out * std::cos(radians), 0.05 * lift * lift, -out * std::sin(radians)};
  foot.yaw = angle + sign * 7.0;
  foot.pitch = -14.0 * lift * lift;
  foot.toes = 14.0;
  return foot;
}

}  // namespace

Posture standing(const Build& build) {
  Posture p;
  for (int side = 0; side < 2; ++side) {
    const double sign = side == 0 ? 1.0 : -1.0;
    p.foot[side].ground.x() = 1.1 * sign * build.hip_half_width;
    p.foot[side].yaw = 7.0 * sign;
  }
  return p;
}

Posture turn(double phase, const Build& build) {
  Posture p;
  const double steps = kSteps * phase, swing = 2.0 * std::numbers::pi * steps;
  p.foot[0] = stepping_foot(steps, build, 0);
  p.foot[1] = stepping_foot(steps - 0.5, build, 1);
  // The counts of steps of both feet begin between steps. The pelvis turns evenly, a little behind the
  // shoulders.
  p.yaw = 360.0 * phase - 0.25 * 360.0 / kSteps;
  const double heading = p.yaw * std::numbers::pi / 180.0;
  const double sway = -0.02 * std::sin(swing);
  p.hips = {sway * std::cos(heading), -0.012 - 0.008 * std::cos(2.0 * swing), -sway * std::sin(heading)};
  p.roll = -2.5 * std::sin(swing);
  p.bend = -2.0 * std::sin(swing);
  p.turn = 5.0;
  p.look = 12.0;
  for (int side = 0; side < 2; ++side) {
    p.arm[side].raise = 14.0;
    p.arm[side].forward = (side == 0 ? 1.0 : -1.0) * 6.0 * std::sin(swing);
    p.arm[side].elbow = 20.0;
  }
  return p;
}

Posture spin(double phase, const Build& build) {
  Posture p = standing(build);
  p.yaw = 720.0 * phase;
  const double heading = p.yaw * std::numbers::pi / 180.0;
  for (int side = 0; side < 2; ++side) {
    const double out = (side == 0 ? 0.9 : -0.9) * build.hip_half_width;
    p.foot[side].ground = {out * std::cos(heading), 0.0, -out * std::sin(heading)};
    p.foot[side].yaw += p.yaw;
    p.arm[side].raise = 32.0;
    p.arm[side].elbow = 30.0;
  }
  return p;
}

}  // namespace bodice::rigging
