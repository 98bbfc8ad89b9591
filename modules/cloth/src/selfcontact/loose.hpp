// Particles and edges that other layers may pass. Where the body left no room, or where cloth crossed at the
// start, parts of layers are on the wrong side of each other, and contact would keep them there. So contact
// does not act between the corners of triangles that cross, where one of them is on the wrong side, and where
// an edge passes through a triangle. Around these it acts, or tangles would grow.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "selfcontact/wrong_side.hpp"

namespace bodice::inline v0_1::cloth {

/// What is loose.
struct Loose {
  CrossingParts parts;
  std::vector<std::uint8_t> is_corner;  ///< #P: whether the particle is a corner of a tangle, or beyond one
  std::vector<std::uint8_t> may_pass;   ///< #P: whether it is on the wrong side, or its side is undecided
  std::vector<Index> list;              ///< the particles with `is_corner`
};

/// The state for this number of particles, none of them loose.
Loose make_loose(std::size_t particles);

/// Finds what is loose around all tangles at positions `at`. Cost: that of find_crossing_parts().
void loosen(const ContactMesh& mesh, std::span<const Tangle> tangles, std::span<const Point> at,
            Loose& loose);

/// The same as are_loose(), for a pair of which both parts have corners of tangles.
bool corners_are_loose(const Index (&particle)[4], bool edges, const Loose& loose);

/// Whether contact does not act between the two parts of a pair.
inline bool are_loose(const Index (&particle)[4], bool edges, const Loose& loose) {
  const auto& is_corner = loose.is_corner;
  const bool first = is_corner[particle[0]] || (edges && is_corner[particle[1]]);
  return first && (is_corner[particle[2]] || is_corner[particle[3]] || (!edges && is_corner[particle[1]])) &&
         corners_are_loose(particle, edges, loose);
}

}  // namespace bodice::cloth
