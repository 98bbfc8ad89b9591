// What stays apart from slice to slice of a body: limbs, and the trunk.
#pragma once

#include <vector>

#include "walls/slices.hpp"

namespace bodice::inline v0_1::anatomy {

inline constexpr int kNoTrack = -1;

/// A lobe of the slices, followed from one to the next. A lobe is deeper than the necks that join it to
/// others.
struct Track {
  std::size_t first = 0, last = 0;         ///< slices
  int below = kNoTrack, above = kNoTrack;  ///< the tracks that it comes out of, and merges into
  int renamed = kNoTrack;                  ///< the track that it continues
  double nodes = 0.0;

  std::size_t length() const { return last - first + 1; }
};

/// All tracks of a body, and the one of each node.
struct LimbTracks {
  std::vector<Track> tracks;
  std::vector<int> of_node;  ///< #nodes; kNoTrack outside of the body

  Track& operator[](int t) { return tracks[static_cast<std::size_t>(t)]; }
  const Track& operator[](int t) const { return tracks[static_cast<std::size_t>(t)]; }
};

/// A neck with less than the share `neck` of the depth of the shallower lobe parts two of them. A lobe goes
/// on in the one of the next slice with the most nodes in common, unless that is `most_area` nodes large and
/// much larger: the trunk is no leg. O(#nodes log #nodes).
LimbTracks limb_tracks(const Slices& slices, double neck, double most_area);

}  // namespace bodice::anatomy
