// Particles that other layers may pass. Where the body left no room, or where cloth crossed at the start,
// layers are on the wrong side of each other, and contact would keep them there. So the corners of triangles
// that cross are loose: contact does not act between loose particles.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "pairs/pairs.hpp"

namespace bodice::inline v0_1::cloth {

/// The particles that are loose.
struct Loose {
  std::vector<std::uint8_t> is_loose;  ///< #P
  std::vector<Index> list;
};

/// The state for this number of particles, none of them loose.
Loose make_loose(std::size_t particles);

/// Makes the corners of all tangles loose, and no other particle. When the corners' neighbors were loose as
/// well, tangles grew.
void loosen(const ContactMesh& mesh, std::span<const Tangle> tangles, Loose& loose);

/// Whether both parts of a pair have loose particles.
inline bool are_loose(const Index (&particle)[4], bool edges, std::span<const std::uint8_t> loose) {
  const bool first = loose[particle[0]] || (edges && loose[particle[1]]);
  return first && (loose[particle[2]] || loose[particle[3]] || (!edges && loose[particle[1]]));
}

}  // namespace bodice::cloth
