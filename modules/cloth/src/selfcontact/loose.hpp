// Which particles layers may pass. Where the body left no room, or where the simulation began crossed, layers
// are on each other's wrong side, and contact would keep them there. So the corners of triangles that cross
// are loose: contact does not act between them.
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

Loose make_loose(std::size_t particles);

/// Loosens the corners of all triangles that cross, and no other particles. With the corners' neighbors, more
/// layers crossed near a tangle than it had to begin with.
void loosen(const ContactMesh& mesh, std::span<const Tangle> tangles, Loose& loose);

/// Whether both parts of a pair have loose particles.
inline bool are_loose(const Index (&particle)[4], bool edges, std::span<const std::uint8_t> loose) {
  const bool first = loose[particle[0]] || (edges && loose[particle[1]]);
  return first && (loose[particle[2]] || loose[particle[3]] || (!edges && loose[particle[1]]));
}

}  // namespace bodice::cloth
