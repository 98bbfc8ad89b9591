#include <algorithm>
#include <cmath>

#include "mesh/cage_plan.hpp"

namespace bodice::inline v0_1::synth {

Vec3 CagePlan::arm_point(int side, double s, double angle, double out, double front) const {
  const LimbAxes& axes = f.arm[side];
  return f.joint[index(of_side(Bone::kUpperArmL, side))] + s * axes.along + out * std::sin(angle) * axes.out +
         front * std::cos(angle) * axes.front;
}

namespace {

// The angle of point n around the arm: from the upper back corner over the shoulder to the front, below, and
// up the back.
double arm_angle(int n) {
  return (150.0 - 30.0 * n) * CagePlan::kDegree;
}

}  // namespace

Loop CagePlan::armhole_loop(int side) const {
  const int i = side == 0 ? kAcross : 0;
  Loop loop;
  for (int k = 0; k <= kDeep; ++k) loop.push_back(level[kTop][number_of(i, k)]);
  loop.push_back(level[kTop - 1][number_of(i, kDeep)]);
  for (int k = kDeep; k >= 0; --k) loop.push_back(level[kArmLow][number_of(i, k)]);
  loop.push_back(level[kTop - 1][number_of(i, 0)]);
  return loop;
}

void CagePlan::place_armhole(int side) {
  const Loop loop = armhole_loop(side);
  for (int n = 0; n < static_cast<int>(loop.size()); ++n) {
    const double angle = arm_angle(n);
    // The hole leans, so that its top lies further along the arm than its bottom.
    cage.position(loop[n]) =
        arm_point(side, 0.004 + 0.012 * std::max(0.0, -std::sin(angle)), angle, 0.036, 0.036);
  }
}

void CagePlan::arm(int side) {
  const Region region = region_of_side(Region::kArmL, side);
  const double upper = f.upper_arm_length(), lower = f.forearm_length();
  Loop ring = armhole_loop(side);
  for (const double s : {0.22 * upper, 0.45 * upper, 0.72 * upper, upper, upper + 0.3 * lower,
                         upper + 0.65 * lower, upper + lower}) {
    const double radius = s < upper ? 0.028 : 0.02;
    ring = cage.extrude(
        ring, [&](int n) { return arm_point(side, s, arm_angle(n), radius, radius); }, region);
  }
  hand(side, ring);
}

void CagePlan::hand(int side, const Loop& wrist) {
  const Region region = region_of_side(Region::kArmL, side);
  const double start = f.arm_length(), hand = f.p.hand;
  const auto palm = [&](double s, double half) {
    return [&, s, half](int n) {
      // The ring has five points across the back of the hand and the palm, and one at each edge.
      const double out = n <= 4 ? 0.008 : n == 5 || n == 11 ? 0.0 : -0.008;
      const double across = n <= 4 ? n - 2.0 : n == 5 ? 2.2 : n == 11 ? -2.2 : 8.0 - n;
      return Vec3(arm_point(side, start + s, 0.0, 0.0, 0.0) + out * f.arm[side].out +
                  0.5 * half * across * f.arm[side].front);
    };
  };
  const Loop near = cage.extrude(wrist, palm(0.14 * hand, 0.019), region);
  constexpr std::array<int, 2> kThumbSide = {4, 5};
  const Loop far = cage.extrude(near, palm(0.34 * hand, 0.021), region, kThumbSide);
  const Loop knuckles = cage.extrude(far, palm(0.53 * hand, 0.021), region);
  // The loop runs from the finger side of the thumb over the back of the hand to the wrist side.
  digit(side, 4, {far[4], near[4], near[5], near[6], far[6], far[5]});
  fingers(side, knuckles);
}

void CagePlan::fingers(int side, const Loop& knuckles) {
  using Column = std::array<int, 3>;  // top, middle, bottom
  std::array<Column, 5> web;          // from the little finger's side
  for (int k = 0; k <= 4; ++k) {
    const int top = knuckles[k], bottom = knuckles[10 - k];
    int middle = k == 0 ? knuckles[11] : knuckles[5];
    if (k > 0 && k < 4)
      middle = cage.add(0.5 * (cage.position(top) + cage.position(bottom)) + 0.003 * f.arm[side].along);
    web[k] = {top, middle, bottom};
  }
  for (int d = 0; d < 4; ++d) {
    const Column &low = web[3 - d], &high = web[4 - d];
    digit(side, d, {low[0], high[0], high[1], high[2], low[2], low[1]});
  }
}

void CagePlan::digit(int side, int digit, Loop loop) {
  const Digit d = digit_of(f, side, digit);
  const Region region = digit_region(side, digit);
  const auto position = [&](double share) {
    return [&d, share](int n) {
      const double angle = (120.0 - 60.0 * n) * kDegree;
      return Vec3(d.base + share * d.length * d.along +
                  d.radius * (std::cos(angle) * d.front + std::sin(angle) * d.out));
    };
  };
  for (const double share : {0.33, 0.65, 0.95}) loop = cage.extrude(loop, position(share), region);
  cage.lid(loop, 1, 2, Vec3::Zero(), region);
}

}  // namespace bodice::synth
