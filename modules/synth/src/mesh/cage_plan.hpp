// The plan of the cage: the loops at which tubes begin.
#pragma once

#include <array>
#include <numbers>

#include "mesh/cage_builder.hpp"

namespace bodice::inline v0_1::synth {

struct CagePlan {
  static constexpr int kAcross = 8, kDeep = 4;  ///< the trunk's columns along x and along z
  static constexpr int kArmLow = 6, kTop = 8;   ///< the armhole takes the levels from kArmLow to kTop
  static constexpr int kPerimeter = 2 * (kAcross + kDeep);
  static constexpr double kDegree = std::numbers::pi / 180.0;

  const Figure& f;
  CageBuilder cage = {};
  std::array<Loop, kTop + 1> level = {};  ///< kPerimeter vertices each, from the back right corner
  Loop crotch = {};                       ///< between the legs, from back to front

  void trunk();
  void arm(int side);
  void leg(int side);
  void head();

 private:
  void trunk_level(int j, double y, double side, double deep, double lift);
  void shoulder_line();
  Loop armhole_loop(int side) const;
  void place_armhole(int side);
  Vec3 arm_point(int side, double s, double angle, double out, double front) const;
  void hand(int side, const Loop& wrist);
  void fingers(int side, const Loop& knuckles);
  void digit(int side, int digit, Loop loop);
  Loop leg_loop(int side) const;
  struct FootRing {
    double back_y, back_z, front_y, front_z, half;  ///< heights above the sole, z from the ankle
  };
  Loop foot_ring(int side, const Loop& from, const FootRing& ring);
};

/// A point of a trunk level's perimeter: column i from right to left, k from back to front.
struct Lattice {
  int i, k;
};
Lattice lattice_of(int number);
int number_of(int i, int k);

}  // namespace bodice::synth
