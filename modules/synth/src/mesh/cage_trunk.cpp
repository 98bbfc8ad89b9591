#include <cmath>
#include <limits>

#include "mesh/cage_plan.hpp"

namespace bodice::inline v0_1::synth {

Lattice lattice_of(int n) {
  constexpr int kAcross = CagePlan::kAcross, kDeep = CagePlan::kDeep;
  if (n < kAcross) return {n, 0};
  if (n < kAcross + kDeep) return {kAcross, n - kAcross};
  if (n < 2 * kAcross + kDeep) return {2 * kAcross + kDeep - n, kDeep};
  return {0, CagePlan::kPerimeter - n};
}

int number_of(int i, int k) {
  constexpr int kAcross = CagePlan::kAcross, kDeep = CagePlan::kDeep;
  if (k == 0) return i;
  if (i == kAcross) return kAcross + k;
  if (k == kDeep) return 2 * kAcross + kDeep - i;
  return CagePlan::kPerimeter - k;
}

void CagePlan::trunk_level(int j, double y, double side, double deep, double lift) {
  for (int n = 0; n < kPerimeter; ++n) {
    const Lattice at = lattice_of(n);
    if (j == kTop - 1 && at.i % kAcross == 0 && at.k % kDeep != 0) {  // inside the armhole
      level[j].push_back(-1);
      continue;
    }
    const double angle = (-90.0 + 360.0 / kPerimeter * (n - 4.0)) * kDegree;
    const double rise = lift * std::abs(at.i - kAcross / 2) / (kAcross / 2);
    level[j].push_back(cage.add({side * std::cos(angle), y + rise, deep * std::sin(angle) - 0.005}));
  }
}

// Shapes the top level, which runs around the neck in the middle and over the shoulders at the sides.
void CagePlan::shoulder_line() {
  for (int n = 0; n < kPerimeter; ++n) {
    const Lattice at = lattice_of(n);
    const double z = 0.5 * at.k - 1.0;
    Vec3& top = cage.position(level[kTop][n]);
    if (at.i >= 2 && at.i <= 6) {
      const double a = 22.5 * (at.i - 4) * kDegree;
      top = {0.04 * std::sin(a), f.p.neck_height - 0.01 - 0.012 * z, -0.012 + 0.04 * z * std::cos(a)};
    } else if (at.i == 1 || at.i == 7) {
      top = {at.i == 1 ? -0.066 : 0.066, f.p.acromion_height + 0.012, -0.01 + 0.035 * z};
    }
  }
}

void CagePlan::trunk() {
  const double c = f.p.crotch_height, w = f.p.waist_height, ax = f.p.axilla_height;
  trunk_level(0, c + 0.002, 0.095, 0.06, 0.07);
  trunk_level(1, c + 0.35 * (w - c), 0.095, 0.06, 0.04);
  trunk_level(2, c + 0.68 * (w - c), 0.088, 0.055, 0.02);
  trunk_level(3, w + 0.01, 0.078, 0.05, 0.0);
  trunk_level(4, w + 0.35 * (ax - w), 0.076, 0.05, 0.0);
  trunk_level(5, w + 0.68 * (ax - w), 0.082, 0.058, 0.0);
  trunk_level(6, ax - 0.005, 0.086, 0.062, 0.0);
  trunk_level(7, ax + 0.028, 0.086, 0.055, 0.0);
  trunk_level(kTop, f.p.acromion_height, 0.09, 0.04, 0.0);
  shoulder_line();
  place_armhole(0);
  place_armhole(1);
  constexpr std::array<int, 8> kSides = {8, 9, 10, 11, 20, 21, 22, 23};
  for (int j = 0; j < kTop; ++j)
    cage.band(level[j], level[j + 1], Region::kTrunk,
              j >= kArmLow ? std::span<const int>(kSides) : std::span<const int>());
  for (int k = 0; k <= kDeep; ++k) {
    const bool edge = k == 0 || k == kDeep;
    const int v = edge ? level[0][number_of(4, k)] : cage.add({0.0, c, -0.005 + 0.02 * (k - 2)});
    if (!edge) cage.mark_crotch(v);
    crotch.push_back(v);
  }
}

// Adds the head, a tube of 16 from the top level's middle columns, and the tops of the shoulders beside it.
void CagePlan::head() {
  std::array<std::array<int, kDeep + 1>, kAcross + 1> top;
  for (int i = 0; i <= kAcross; ++i)
    for (int k = 0; k <= kDeep; ++k) {
      const bool rim = i == 0 || i == kAcross || k == 0 || k == kDeep;
      if (rim) {
        top[i][k] = level[kTop][number_of(i, k)];
      } else if (i == 2 || i == 6) {
        const double a = 22.5 * (i - 4) * kDegree * (k == 2 ? 2.0 : 1.5), z = 0.5 * k - 1.0;
        top[i][k] = cage.add({0.04 * std::sin(a), f.p.neck_height - 0.01 - 0.012 * z, -0.012 + 0.03 * z});
      } else if (i == 1 || i == 7) {
        top[i][k] =
            cage.add({i == 1 ? -0.066 : 0.066, f.p.acromion_height + 0.018, -0.01 + 0.0175 * (k - 2)});
      } else {
        top[i][k] = -1;
      }
    }
  for (const int i : {0, 1, 6, 7})
    for (int k = 0; k < kDeep; ++k)
      cage.quad(top[i][k], top[i + 1][k], top[i + 1][k + 1], top[i][k + 1], Region::kTrunk);

  Loop ring;  // from the back right corner, like a trunk level
  for (int i = 2; i < 6; ++i) ring.push_back(top[i][0]);
  for (int k = 0; k < kDeep; ++k) ring.push_back(top[6][k]);
  for (int i = 6; i > 2; --i) ring.push_back(top[i][kDeep]);
  for (int k = kDeep; k > 0; --k) ring.push_back(top[2][k]);
  const double chin = 1.0 - f.p.head_length, l = f.p.head_length;
  struct Ring {
    double front_y, front_z, back_y, back_z, half;
  };
  for (const Ring& r : {Ring{chin - 0.012, 0.012, chin + 0.02, -0.045, 0.033},
                        {chin - 0.002, 0.04, chin + 0.2 * l, -0.04, 0.034},
                        {chin + 0.1 * l, 0.068, chin + 0.33 * l, -0.045, 0.038},
                        {chin + 0.32 * l, 0.07, chin + 0.46 * l, -0.05, 0.044},
                        {chin + 0.54 * l, 0.068, chin + 0.6 * l, -0.053, 0.047},
                        {chin + 0.76 * l, 0.062, chin + 0.76 * l, -0.05, 0.045},
                        {chin + 0.92 * l, 0.04, chin + 0.92 * l, -0.03, 0.03}})
    ring = cage.extrude(
        ring,
        [&](int n) {
          const double a = (-135.0 + 22.5 * n) * kDegree, s = 0.5 * (1.0 + std::sin(a));
          return Vec3(r.half * std::cos(a), r.back_y + s * (r.front_y - r.back_y),
                      r.back_z + s * (r.front_z - r.back_z));
        },
        Region::kHead);
  cage.lid(ring, 4, 4, Vec3(0.0, 0.05 * l, 0.0), Region::kHead);
}

Cage make_cage(const Figure& figure) {
  CagePlan plan{figure};
  plan.trunk();
  plan.head();
  for (int side = 0; side < 2; ++side) {
    plan.arm(side);
    plan.leg(side);
  }
  return plan.cage.finish();
}

}  // namespace bodice::synth
