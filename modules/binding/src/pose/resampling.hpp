// The texels of a table that follows the skin, in vector code: where each is read at rest, and what it
// becomes.
#pragma once

#include <algorithm>
#include <limits>

#include "pose/followed_table.hpp"
#include "pose/lanes.hpp"
#include "pose/yield.hpp"

namespace bodice::inline v0_1::binding {

/// Texels that go through each step together: enough that a step's results have left the processor's store
/// queue before the next one reads them in other portions.
constexpr int kChunk = 4 * kLanes;
using Chunk = float[kChunk];

/// The least and the largest value of each lane.
struct Range {
  Chunk low, high;

  Range() {
    std::fill_n(low, kChunk, std::numeric_limits<float>::infinity());
    std::fill_n(high, kChunk, -std::numeric_limits<float>::infinity());
  }
  float least() const { return *std::min_element(low, low + kChunk); }
  float most() const { return *std::max_element(high, high + kChunk); }
};

/// What the resampling of a table needs besides its scratch.
struct Resampling {
  int nodes = 0;
  float to_table[9] = {};               ///< by rows
  float scale = 1.0f;                   ///< scale of the ellipsoid since rest
  float inverse_out = 0.0f;             ///< 1 over the reach of relief at rest, 1/m
  float least_m = 0.0f, most_m = 0.0f;  ///< bounds on heights; slopes lie between the first and its negative
  YieldRule yield;
  float per_step = 0.0f;  ///< steps of burial a meter of score; zero where there is no burial
  Range h, a;             ///< range of the values written
};

/// Finds the shift of each texel: scratch.shift, from scratch.changes. Rows of the coarser table are spread
/// over all columns first, then over all rows.
void find_shifts(const Resampling& to, TableScratch& scratch);

/// Heights and slopes of the pose in scratch.h and scratch.a, meters, from scratch.rest; scratch.burial from
/// the table's burial at rest and from how far its skin has left it.
void resample(Resampling& to, const std::uint8_t* buried, TableScratch& scratch);

}  // namespace bodice::binding
