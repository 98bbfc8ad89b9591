#include <cmath>

#include "mesh/cage_plan.hpp"

namespace bodice::inline v0_1::synth {
namespace {

double leg_angle(int n) {
  return (135.0 - 22.5 * n) * CagePlan::kDegree;
}

}  // namespace

// The loop around the leg from the front inner corner outward, back along the outside, and forward between
// the legs.
Loop CagePlan::leg_loop(int side) const {
  const auto column = [&](int n) { return side == 0 ? 4 + n : 4 - n; };
  Loop loop;
  for (int n = 0; n <= 4; ++n) loop.push_back(level[0][number_of(column(n), kDeep)]);
  for (int k = 3; k >= 0; --k) loop.push_back(level[0][number_of(column(4), k)]);
  for (int n = 3; n >= 0; --n) loop.push_back(level[0][number_of(column(n), 0)]);
  for (int k = 1; k <= 3; ++k) loop.push_back(crotch[k]);
  return loop;
}

void CagePlan::leg(int side) {
  const Region region = region_of_side(Region::kLegL, side);
  const LimbAxes& axes = f.leg[side];
  const Vec3& hip = f.joint[index(of_side(Bone::kThighL, side))];
  const double thigh = f.thigh_length(), calf = f.leg_length() - thigh;
  Loop ring = leg_loop(side);
  const auto position = [&](double s, double radius) {
    return [&, s, radius](int n) {
      const double a = leg_angle(n);
      return Vec3(hip + s * axes.along + radius * (std::cos(a) * axes.out + std::sin(a) * axes.front));
    };
  };
  for (const double share : {0.38, 0.58, 0.8, 1.0})
    ring = cage.extrude(ring, position(share * thigh, 0.042), region);
  for (const double share : {0.2, 0.42, 0.66, 0.9})
    ring = cage.extrude(ring, position(thigh + share * calf, 0.026), region);
  const double h = f.ankle_height, l = f.p.foot_length;
  // The tube bends forward over the heel: its back runs down and along the sole, its front over the instep.
  for (const FootRing& r : {FootRing{0.9 * h, -0.16 * l, 1.1 * h, 0.14 * l, 0.02},
                            {0.0, -0.2 * l, 0.95 * h, 0.26 * l, 0.022},
                            {0.0, 0.08 * l, 0.75 * h, 0.4 * l, 0.026},
                            {0.0, 0.42 * l, 0.55 * h, 0.55 * l, 0.03},
                            {0.0, 0.66 * l, 0.4 * h, 0.68 * l, 0.026}})
    ring = foot_ring(side, ring, r);
  cage.lid(ring, 4, 4, Vec3(0.0, 0.0, 0.06 * l), region);
}

Loop CagePlan::foot_ring(int side, const Loop& from, const FootRing& r) {
  const Vec3& ankle = f.joint[index(of_side(Bone::kFootL, side))];
  const double sign = side == 0 ? 1.0 : -1.0;
  const Vec3 sole = ankle - Vec3(0.0, f.ankle_height, 0.0);
  const Vec3 back = sole + Vec3(0.0, r.back_y, r.back_z), front = sole + Vec3(0.0, r.front_y, r.front_z);
  const auto position = [&](int n) {
    const double a = leg_angle(n);
    const Vec3 p = 0.5 * (back + front) + 0.5 * std::sin(a) * (front - back);
    const double turned_out = 0.1 * (p.z() - ankle.z());
    return Vec3(p + Vec3(sign * (r.half * std::cos(a) + turned_out), 0.0, 0.0));
  };
  return cage.extrude(from, position, region_of_side(Region::kLegL, side));
}

}  // namespace bodice::synth
