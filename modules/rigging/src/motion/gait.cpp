// Based on: Jacquelin Perry, Judith M. Burnfield. Gait analysis: normal and pathological function. 2010.
// Phases and ranges of joints follow its normal gait; the curves are the author's. Knees of the run bend to
// 103 degrees, as at its 2.7 m/s; those of a sprint bend to 130 (Tom F. Novacheck. The biomechanics of
// running. 1998).
//
// A cycle begins when the left heel strikes. The right side does the same half a cycle later.
//
//   phase   0 ......... .12 ............ .50 ....... .62 ............... 1
//   left    heel strikes, flat ........ heel rises, toes off, swing ......
//   right   heel rises,  toes off, swing ........... heel strikes, flat ..
#include <algorithm>
#include <cmath>
#include <numbers>

#include "motion/motions.hpp"
#include "posture/curve.hpp"

namespace bodice::inline v0_1::rigging {
namespace {

using Ends = Curve::Ends;

double wave(double phase, double shift) {
  return std::cos(2.0 * std::numbers::pi * (phase - shift));
}

/// When the toes leave the floor in a gait, how far a cycle comes, and where the foot strikes.
struct Gait {
  double toes_off, stride, strike;
  double half_width;  ///< of the feet's tracks, in half widths of the hips
  double toe_out;     ///< degrees
};
constexpr Gait kWalk{.toes_off = 0.62, .stride = 1.34, .strike = 0.34, .half_width = 0.72, .toe_out = 6.0};
constexpr Gait kRun{.toes_off = 0.38, .stride = 2.2, .strike = 0.30, .half_width = 0.45, .toe_out = 4.0};

/// The position of a foot along the body's heading: backward with the floor in stance, forward in swing,
/// without a jump of speed.
double travel_of_foot(const Gait& gait, double phase) {
  phase -= std::floor(phase);
  const double off = gait.strike - gait.stride * gait.toes_off;
  if (phase <= gait.toes_off) return gait.strike - gait.stride * phase;
  const double h = 1.0 - gait.toes_off, s = (phase - gait.toes_off) / h, s2 = s * s, s3 = s2 * s;
  const double slope = -gait.stride * h;
  return (2.0 * s3 - 3.0 * s2 + 1.0) * off + (s3 - 2.0 * s2 + s) * slope +
         (3.0 * s2 - 2.0 * s3) * gait.strike + (s3 - s2) * slope;
}

FootPosture foot_of(const Gait& gait, const Build& build, double phase, int side) {
  const double sign = side == 0 ? 1.0 : -1.0;
  FootPosture foot;
  foot.ground = {sign * gait.half_width * build.hip_half_width, 0.0, travel_of_foot(gait, phase)};
  foot.yaw = sign * gait.toe_out;
  // Toes stay flat on the floor until they leave it, and stretch in the air.
  const double in_air = phase - std::floor(phase) - gait.toes_off;
  foot.toes = std::clamp(74.0 - 500.0 * in_air, 0.0, 90.0);
  return foot;
}

void walk_side(double phase, const Build& build, int side, Posture& p) {
  static const Curve pitch({{0.0, 18.0},
                            {0.08, 0.0},
                            {0.36, 0.0},
                            {0.50, -20.0},
                            {0.62, -56.0},
                            {0.72, -42.0},
                            {0.84, -4.0},
                            {0.93, 14.0},
                            {1.0, 18.0}},
                           Ends::kPeriodic);
  static const Curve lift({{0.0, 0.0}, {0.60, 0.0}, {0.65, 0.018}, {0.72, 0.058}, {0.84, 0.024}, {1.0, 0.0}},
                          Ends::kPeriodic);
  FootPosture& foot = p.foot[side] = foot_of(kWalk, build, phase, side);
  foot.pitch = pitch(phase);
  foot.ground.y() = lift(phase);
  ArmPosture& arm = p.arm[side];
  arm.forward = -3.0 - 22.0 * wave(phase, 0.02);
  arm.elbow = 20.0 - 10.0 * wave(phase, 0.06);
}

void run_side(double phase, const Build& build, int side, Posture& p) {
  static const Curve pitch({{0.0, 6.0},
                            {0.06, 0.0},
                            {0.18, 0.0},
                            {0.38, -58.0},
                            {0.55, -88.0},
                            {0.78, -22.0},
                            {0.92, 6.0},
                            {1.0, 6.0}},
                           Ends::kPeriodic);
  static const Curve lift({{0.0, 0.0}, {0.34, 0.0}, {0.40, 0.035}, {0.60, 0.15}, {0.82, 0.06}, {1.0, 0.0}},
                          Ends::kPeriodic);
  FootPosture& foot = p.foot[side] = foot_of(kRun, build, phase, side);
  foot.pitch = pitch(phase);
  foot.ground.y() = lift(phase);
  ArmPosture& arm = p.arm[side];
  arm.raise = 20.0;  // bent forearms would cut into the waist below that
  arm.forward = -8.0 - 36.0 * wave(phase, 0.03);
  arm.twist = 6.0 - 14.0 * wave(phase, 0.03);  // hands that go back pass the hips, and what these wear
  arm.elbow = 88.0 - 10.0 * wave(phase, 0.08);
}

}  // namespace

double walking_stride() {
  return kWalk.stride;
}

double running_stride() {
  return kRun.stride;
}

Posture walk(double phase, const Build& build) {
  Posture p;
  for (int side = 0; side < 2; ++side) walk_side(phase + 0.5 * side, build, side, p);
  p.hips = {0.028 * wave(phase, 0.31), -0.029 * wave(2.0 * phase, 0.08), 0.0};
  p.yaw = -5.0 * wave(phase, 0.0);
  p.roll = 4.0 * wave(phase, 0.18);
  p.pitch = 2.0;
  p.lean = 1.0;
  p.bend = 3.5 * wave(phase, 0.18);
  p.turn = 10.0 * wave(phase, 0.02);
  p.look = -5.0 * wave(phase, 0.02);
  return p;
}

Posture run(double phase, const Build& build) {
  Posture p;
  for (int side = 0; side < 2; ++side) run_side(phase + 0.5 * side, build, side, p);
  p.hips = {0.012 * wave(phase, 0.18), -0.05 - 0.034 * wave(2.0 * phase, 0.32), 0.0};
  p.yaw = -7.0 * wave(phase, 0.02);
  p.roll = 4.0 * wave(phase, 0.14);
  p.pitch = 6.0;
  p.lean = 7.0;
  p.nod = -9.0;
  p.bend = 3.0 * wave(phase, 0.14);
  p.turn = 16.0 * wave(phase, 0.03);
  p.look = -9.0 * wave(phase, 0.03);
  return p;
}

}  // namespace bodice::rigging
