// The coarse quad mesh that gives every body its connectivity: the trunk, and a tube for each limb.
//
//   trunk: 9 levels of 24 vertices        top view of a level (x to the left, z up)
//   arm:   tube of 12, from the side           k=4  . . . . . . . . .   front
//   leg:   tube of 16, from below              ...  .               .
//   neck:  tube of 16, from the top            k=0  . . . . . . . . .   back
//   digit: tube of 6, from the end or side of the palm  i=0 ........ 8 (left)
//
// Closed, one component, genus 0 by construction; the left mirrors the right.
#pragma once

#include <array>
#include <vector>

#include "figure/flesh.hpp"

namespace bodice::inline v0_1::synth {

struct Cage {
  using Quad = std::array<int, 4>;
  std::vector<Vec3> positions;      ///< rest pose, near the skin, units of stature
  std::vector<Quad> quads;          ///< counter-clockwise seen from outside
  std::vector<Region> quad_region;  ///< #quads
  std::vector<Region> region;       ///< #positions: region of the skin that holds the vertex
};

Cage make_cage(const Figure& figure);

}  // namespace bodice::synth
