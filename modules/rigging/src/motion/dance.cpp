// Steps to the left and back, with a touch, in eight beats.
#include <cmath>
#include <numbers>

#include "motion/motions.hpp"
#include "posture/curve.hpp"

namespace bodice::inline v0_1::rigging {
namespace {

using Ends = Curve::Ends;

double beat(double phase, double count) {
  return std::sin(2.0 * std::numbers::pi * count * phase);
}

/// A step to the left and back, twice in the clip: the left foot steps out, the right follows, and both come
/// back. Returns how far the middle of the body is to the left.
double step_aside(double step, Posture& p) {
  constexpr double kOut = 0.34;  // of the leg
  static const Curve left({{0.0, 0.0}, {0.06, 0.0}, {0.22, 1.0}, {0.78, 1.0}, {0.94, 0.0}, {1.0, 0.0}},
                          Ends::kPeriodic);
  static const Curve right({{0.0, 0.0}, {0.28, 0.0}, {0.46, 1.0}, {0.56, 1.0}, {0.74, 0.0}, {1.0, 0.0}},
                           Ends::kPeriodic);
  static const Curve left_lift({{0.0, 0.0},
                                {0.06, 0.0},
                                {0.14, 0.07},
                                {0.22, 0.0},
                                {0.78, 0.0},
                                {0.86, 0.07},
                                {0.94, 0.0},
                                {1.0, 0.0}},
                               Ends::kPeriodic);
  static const Curve right_lift({{0.0, 0.0},
                                 {0.28, 0.0},
                                 {0.37, 0.07},
                                 {0.46, 0.0},
                                 {0.56, 0.0},
                                 {0.65, 0.07},
                                 {0.74, 0.0},
                                 {1.0, 0.0}},
                                Ends::kPeriodic);
  p.foot[0].ground.x() += kOut * left(step);
  p.foot[1].ground.x() += kOut * right(step);
  p.foot[0].ground.y() = left_lift(step);
  p.foot[1].ground.y() = right_lift(step);
  for (FootPosture& foot : p.foot) {
    foot.pitch = -200.0 * foot.ground.y();
    foot.toes = 20.0;
  }
  return 0.5 * kOut * (left(step) + right(step));
}

void swing_arms(double phase, Posture& p) {
  for (int side = 0; side < 2; ++side) {
    const double sign = side == 0 ? 1.0 : -1.0, swing = sign * beat(phase, 2.0);
    ArmPosture& arm = p.arm[side];
    arm.raise = 46.0 + 34.0 * sign * beat(phase, 1.0);
    arm.forward = 24.0 + 26.0 * swing;
    arm.elbow = 62.0 + 26.0 * beat(phase, 4.0);
    arm.twist = -10.0;
  }
}

}  // namespace

Posture dance(double phase, const Build& build) {
  Posture p = standing(build);
  const double middle = step_aside(2.0 * phase, p);
  p.hips = {middle + 0.03 * beat(phase, 2.0), -0.045 - 0.02 * beat(phase, 8.0), 0.015 * beat(phase, 4.0)};
  p.roll = 7.0 * beat(phase, 4.0);
  p.yaw = 10.0 * beat(phase, 2.0);
  p.pitch = 4.0;
  p.bend = 11.0 * beat(phase, 4.0);
  p.turn = -22.0 * beat(phase, 2.0);
  p.look = 14.0 * beat(phase, 1.0);
  p.nod = 4.0 * beat(phase, 8.0);
  swing_arms(phase, p);
  return p;
}

}  // namespace bodice::rigging
