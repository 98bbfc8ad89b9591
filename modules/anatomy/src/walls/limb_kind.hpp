// Which tracks of a body that stands are its arms and its legs.
#pragma once

#include "walls/limb_tracks.hpp"

namespace bodice::inline v0_1::anatomy {

// Lengths are shares of the body's height, areas of slices shares of its square.
inline constexpr double kShortTrack = 0.035;  ///< what lasts no longer is no limb
/// An arm ends above in this range of heights; one that comes out of what it touches is thicker than a
/// finger.
inline constexpr double kArmpitFrom = 0.6, kArmpitTo = 0.92;
inline constexpr double kArmArea = 0.0045, kLeastArmArea = 0.0005, kLeastSplitArea = 0.0008;
/// A leg begins and ends above in these heights, and has a smaller area than the trunk.
inline constexpr double kLegsBelow = 0.15, kCrotchFrom = 0.25, kLegArea = 0.012;

/// The mean area of a track, as a share of the squared height.
inline double mean_area(const Slices& slices, const Track& t) {
  return t.nodes / static_cast<double>(t.length() * slices.count() * slices.count());
}

inline bool is_short(const Slices& slices, const Track& t) {
  return t.length() < slices.count(kShortTrack);
}

inline bool is_arm(const Slices& slices, const Track& t) {
  const double area = mean_area(slices, t);
  return t.renamed == kNoTrack && t.above != kNoTrack && !is_short(slices, t) &&
         t.last > slices.count(kArmpitFrom) && t.last < slices.count(kArmpitTo) && area < kArmArea &&
         area > (t.below == kNoTrack ? kLeastArmArea : kLeastSplitArea);
}

/// The track of the trunk may begin as one of the legs.
inline bool is_leg(const Slices& slices, const Track& t) {
  return t.renamed == kNoTrack && t.first < slices.count(kLegsBelow) && t.last > slices.count(kCrotchFrom);
}

}  // namespace bodice::anatomy
