// Motions on feet that stay where they are.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "motion/motions.hpp"
#include "posture/curve.hpp"

namespace bodice::inline v0_1::rigging {

Posture reach(double phase, const Build& build) {
  static const Curve forward(
      {{0.0, 0.0}, {0.26, 158.0}, {0.38, 158.0}, {0.58, 82.0}, {0.74, 82.0}, {1.0, 0.0}});
  static const Curve other({{0.0, 0.0}, {0.34, 4.0}, {0.58, 80.0}, {0.74, 80.0}, {1.0, 0.0}});
  static const Curve elbow(
      {{0.0, 14.0}, {0.12, 46.0}, {0.26, 10.0}, {0.38, 10.0}, {0.58, 8.0}, {0.74, 8.0}, {1.0, 14.0}});
  static const Curve tiptoe({{0.0, 0.0}, {0.16, 0.0}, {0.28, -24.0}, {0.38, -24.0}, {0.50, 0.0}, {1.0, 0.0}});
  static const Curve lean({{0.0, 0.0}, {0.28, -7.0}, {0.38, -7.0}, {0.60, 22.0}, {0.74, 22.0}, {1.0, 0.0}});
  static const Curve bend({{0.0, 0.0}, {0.28, 7.0}, {0.38, 7.0}, {0.56, 0.0}, {1.0, 0.0}});
  Posture p = standing(build);
  p.lean = lean(phase);
  p.pitch = 0.35 * p.lean;
  p.bend = bend(phase);
  p.nod = -0.7 * p.lean - 0.8 * std::abs(p.bend);
  p.arm[1].forward = forward(phase);
  p.arm[1].elbow = elbow(phase);
  p.arm[0].forward = other(phase);
  for (FootPosture& foot : p.foot) {
    foot.pitch = tiptoe(phase);
    foot.toes = 40.0;
  }
  // The heels' rise lifts the ankles, and the hips with them.
  const double rise = -p.foot[0].pitch * std::numbers::pi / 180.0;
  p.hips = {0.0, 0.17 * rise, -0.0032 * std::max(0.0, p.lean) + 0.02 * rise};
  return p;
}

Posture sit(double phase, const Build& build) {
  static const Curve down({{0.0, 0.0}, {0.06, 0.0}, {0.62, 1.0}, {1.0, 1.0}});
  static const Curve back({{0.0, 0.0}, {0.04, 0.0}, {0.58, 1.0}, {1.0, 1.0}});
  static const Curve lean({{0.0, 0.0}, {0.30, 34.0}, {0.52, 26.0}, {0.74, 0.0}, {1.0, 0.0}});
  static const Curve hands({{0.0, 0.0}, {0.34, 48.0}, {0.52, 40.0}, {0.74, 24.0}, {1.0, 24.0}});
  static const Curve elbow({{0.0, 14.0}, {0.35, 24.0}, {0.74, 58.0}, {1.0, 58.0}});
  Posture p = standing(build);
  // Seated, the thighs are level and the shins upright.
  p.hips = {0.0, -build.thigh * down(phase), -build.thigh * back(phase)};
  p.lean = 0.6 * lean(phase);
  p.pitch = 0.5 * lean(phase);
  p.nod = -0.5 * lean(phase);
  for (ArmPosture& arm : p.arm) {
    arm.forward = hands(phase);
    arm.elbow = elbow(phase);
    arm.raise = 10.0 + 5.0 * down(phase);
    arm.twist = 12.0 * down(phase);
  }
  return p;
}

Posture squat(double phase, const Build& build) {
  static const Curve down({{0.0, 0.0}, {0.04, 0.0}, {0.44, 1.0}, {0.56, 1.0}, {0.96, 0.0}, {1.0, 0.0}});
  Posture p = standing(build);
  const double d = down(phase);
  p.hips = {0.0, -0.46 * d, -0.18 * d};
  p.pitch = 22.0 * d;
  p.lean = 20.0 * d;
  p.nod = -22.0 * d;
  p.knee_out = 12.0 * d;
  for (int side = 0; side < 2; ++side) {
    p.foot[side].ground.x() *= 1.35;
    p.foot[side].yaw *= 2.2;
    p.arm[side].forward = 96.0 * d;
    p.arm[side].elbow = 14.0 - 4.0 * d;
  }
  return p;
}

Posture arms_up(double phase, const Build& build) {
  static const Curve raise(
      {{0.0, 10.0}, {0.04, 10.0}, {0.40, 168.0}, {0.60, 168.0}, {0.96, 10.0}, {1.0, 10.0}});
  static const Curve elbow({{0.0, 14.0}, {0.40, 6.0}, {0.60, 6.0}, {1.0, 14.0}});
  Posture p = standing(build);
  for (ArmPosture& arm : p.arm) {
    arm.raise = raise(phase);
    arm.elbow = elbow(phase);
  }
  p.lean = -0.03 * (p.arm[0].raise - 10.0);
  return p;
}

}  // namespace bodice::rigging
