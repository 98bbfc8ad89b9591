// The tables of arms, hands, legs and feet, in statures. The numbers are the author's, set by eye within the
// girths of the anthropometric surveys.
#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "figure/flesh.hpp"

namespace bodice::inline v0_1::synth {
namespace {

struct DigitRow {
  double across;  // in half widths of the palm, positive on the thumb's side
  double length;  // in lengths of the hand
  double radius;  // in lengths of the hand
  double fan_rad;
};

constexpr std::array<DigitRow, 4> kFingers = {{{0.72, 0.43, 0.052, 0.10},
                                               {0.25, 0.47, 0.054, 0.02},
                                               {-0.23, 0.435, 0.051, -0.06},
                                               {-0.69, 0.345, 0.045, -0.16}}};

double palm_half_width(const Figure& f) {
  return 0.205 * f.p.hand * (f.female() > 0.0 ? 0.95 : 1.05);
}

}  // namespace

Digit digit_of(const Figure& f, int side, int digit) {
  const LimbAxes& arm = f.arm[side];
  const double size = f.p.hand * (f.female() > 0.0 ? 0.96 : 1.04) * (1.0 + 0.12 * std::max(f.fat, -0.5));
  const Vec3& wrist = f.joint[index(of_side(Bone::kHandL, side))];
  if (digit == 4) {
    const double open = 0.72;
    const Vec3 along =
        (std::cos(open) * arm.along + std::sin(open) * arm.front - 0.22 * arm.out).normalized();
    const Vec3 front = (arm.front - arm.front.dot(along) * along).normalized();
    const Vec3 out = arm.out - arm.out.dot(along) * along - arm.out.dot(front) * front;
    return {f.joint[index(of_side(Bone::kThumbL, side))],
            along,
            out.normalized(),
            front,
            0.52 * f.p.hand,
            0.062 * size};
  }
  const DigitRow& row = kFingers[digit];
  const Vec3 along = std::cos(row.fan_rad) * arm.along + std::sin(row.fan_rad) * arm.front;
  const Vec3 front = std::cos(row.fan_rad) * arm.front - std::sin(row.fan_rad) * arm.along;
  const double knuckle = (digit == 3 ? 0.50 : digit == 1 ? 0.53 : 0.52) * f.p.hand;
  const Vec3 base = wrist + knuckle * arm.along + row.across * palm_half_width(f) * arm.front;
  return {base, along, arm.out, front, row.length * f.p.hand, row.radius * size};
}

void Flesh::add_arm(const Figure& f, int side) {
  const LimbAxes& axes = f.arm[side];
  const double upper = f.upper_arm_length(), lower = f.forearm_length(),
               size = f.build.arm * (f.female() > 0.0 ? 0.95 : 1.1);
  const auto row = [&](double s, double side_r, double front, double back, double fat) -> Section {
    const double grow = size * std::max(1.0 + fat * f.fat, 0.5);
    return {s, side_r * grow, front * grow, back * grow, 0.0, 0.0};
  };
  const Region arm = region_of_side(Region::kArmL, side);
  add(arm,
      {{f.joint[index(of_side(Bone::kUpperArmL, side))], axes.along, axes.out, axes.front},
       {row(0.0, .0265, .031, .032, .25), row(0.2 * upper, .0305, .031, .034, .30),
        row(0.5 * upper, .027, .0275, .029, .35), row(0.8 * upper, .0235, .0235, .0245, .32),
        row(upper, .0225, .0225, .0235, .25), row(upper + 0.25 * lower, .0235, .0245, .0235, .25),
        row(upper + 0.6 * lower, .0185, .0205, .019, .20), row(upper + 0.95 * lower, .0125, .016, .0155, .12),
        row(upper + 1.1 * lower, .0105, .0165, .0165, .1)},
       0.028,
       0.012},
      0.022);
  const Vec3& wrist = f.joint[index(of_side(Bone::kHandL, side))];
  const double hand = f.p.hand, half = palm_half_width(f);
  const double pad = 1.0 + 0.2 * std::max(f.fat, -0.5);
  add(arm,
      {{wrist, axes.along, axes.out, axes.front},
       {{0.02 * hand, .095 * hand * pad, 0.72 * half, 0.72 * half, 0, 0},
        {0.2 * hand, .1 * hand * pad, 0.95 * half, 0.9 * half, 0, 0},
        {0.4 * hand, .085 * hand * pad, 1.0 * half, 0.98 * half, 0, 0},
        {0.5 * hand, .066 * hand * pad, 0.95 * half, 0.93 * half, 0, 0}},
       0.1 * hand,
       0.06 * hand,
       0.35},
      0.008);
  for (int d = 0; d < kDigitsPerHand; ++d) {
    const Digit digit = digit_of(f, side, d);
    const double r = digit.radius, l = digit.length;
    add(digit_region(side, d),
        {{digit.base, digit.along, digit.out, digit.front},
         {{-0.05 * l, 1.05 * r, 1.05 * r, 1.05 * r, 0, 0},
          {0.5 * l, 0.98 * r, 0.98 * r, 0.98 * r, 0, 0},
          {l - r, 0.85 * r, 0.85 * r, 0.85 * r, 0, 0}},
         0.8 * r,
         r},
        d == 4 ? 0.006 : 0.003);
  }
}

void Flesh::add_leg(const Figure& f, int side) {
  const LimbAxes& axes = f.leg[side];
  const double thigh = f.thigh_length(), all = f.leg_length(), calf = all - thigh;
  const double size = f.build.leg * (f.female() > 0.0 ? 1.0 : 0.98);
  const auto row = [&](double s, double side_r, double front, double back, double v, double fat) -> Section {
    const double grow = size * std::max(1.0 + fat * f.fat, 0.5);
    return {s, side_r * grow, front * grow, back * grow, 0.0, v};
  };
  const Region leg = region_of_side(Region::kLegL, side);
  add(leg,
      {{f.joint[index(of_side(Bone::kThighL, side))], axes.along, axes.out, axes.front},
       {row(-0.01, .046, .053, .050, .000, .40), row(0.24 * thigh, .052, .053, .051, .002, .50),
        row(0.5 * thigh, .046, .046, .045, .006, .50), row(0.75 * thigh, .038, .039, .037, .008, .40),
        row(thigh, .0315, .034, .032, .006, .25), row(thigh + 0.13 * calf, .0300, .0310, .0325, .000, .25),
        row(thigh + 0.32 * calf, .0320, .0300, .0365, -.002, .35),
        row(thigh + 0.55 * calf, .0270, .0265, .0300, -.003, .30),
        row(thigh + 0.8 * calf, .0190, .0190, .0205, -.003, .20),
        row(thigh + 0.97 * calf, .0185, .0185, .0200, -.002, .10)},
       0.035,
       0.02,
       0.0},
      0.034);
  const Vec3& ankle = f.joint[index(of_side(Bone::kFootL, side))];
  const double sole = ankle.y() - f.ankle_height, l = f.p.foot_length, h = f.ankle_height;
  const double w = f.p.foot_length * (f.female() > 0.0 ? 0.97 : 1.0);
  const double sign = side == 0 ? 1.0 : -1.0, toe_out = 0.1;
  const Vec3 forward(sign * std::sin(toe_out), 0.0, std::cos(toe_out));
  const Vec3 across(std::cos(toe_out), 0.0, -sign * std::sin(toe_out));
  // v points up: `front` is the instep's height above the axis, `back` the sole's depth below it.
  const double axis = 0.30 * h;
  add(leg,
      {{Vec3(ankle.x(), sole + axis, ankle.z()), forward, across, Vec3::UnitY()},
       {{-0.15 * l, .125 * w, 0.85 * h, axis, 0, 0},
        {0.05 * l, .14 * w, 0.85 * h, axis, 0, 0},
        {0.28 * l, .165 * w, 0.62 * h, axis, 0, 0},
        {0.5 * l, .195 * w, 0.36 * h, axis, sign * 0.002, 0},
        {0.66 * l, .185 * w, 0.24 * h, axis, sign * 0.003, 0}},
       0.09 * l,
       0.1 * l,
       0.55},
      0.014);
}

}  // namespace bodice::synth
