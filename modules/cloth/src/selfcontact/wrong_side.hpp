// Which parts of cloth that crosses are on the wrong side. Surfaces cross along lines. Where a line encloses
// a small part of a surface, that part is beyond the other surface, and all around it is on its own side.
// Based on: David Baraff, Andrew Witkin, Michael Kass. Untangling Cloth. 2003. - section 4 (global
// intersection analysis)
// Differs: parts are bounded by edges that pass through an odd number of triangles, and by particles that
// both triangles of a tangle have, instead of by closed paths. A line that encloses no part is undecided.
#pragma once

#include <compare>
#include <cstdint>
#include <span>
#include <vector>

#include "pairs/pairs.hpp"

namespace bodice::inline v0_1::cloth {

/// The ends of an edge, in ascending order.
struct EdgeEnds {
  Index p = 0, q = 0;

  auto operator<=>(const EdgeEnds&) const = default;
};

inline EdgeEnds ends_of(Index p, Index q) {
  return p < q ? EdgeEnds{p, q} : EdgeEnds{q, p};
}

/// An edge that passes through a triangle, which is an index into ContactMesh::faces.
struct Piercing {
  EdgeEnds edge;
  std::uint32_t face = 0;

  auto operator<=>(const Piercing&) const = default;
};

/// The parts of the cloth beside lines of crossing.
struct CrossingParts {
  std::vector<Piercing> piercings;   ///< sorted
  std::vector<EdgeEnds> cut;         ///< edges that pass through an odd number of triangles, sorted
  std::vector<Index> line_ends;      ///< particles that both triangles of a tangle have, sorted
  std::vector<std::uint32_t> part;   ///< #P: the part of a particle, or kNoPart
  std::vector<std::uint32_t> size;   ///< the particles of each part; of the outside kNoPart
  std::vector<std::uint8_t> beyond;  ///< whether a part is on the wrong side
  std::vector<Index> reached;        ///< the particles that have a part
};

CrossingParts make_crossing_parts(std::size_t particles);

/// Finds the parts beside all lines along which triangles cross at positions `at`. Cost: O(t log t) for t
/// tangles, and a visit of at most one particle in eight of the cloth for each piece that crosses.
void find_crossing_parts(const ContactMesh& mesh, std::span<const Tangle> tangles, std::span<const Point> at,
                         CrossingParts& parts);

/// Whether a particle is in a part that is on the wrong side.
bool is_beyond(const CrossingParts& parts, Index i);

/// The triangles that an edge passes through.
std::span<const Piercing> piercings_of(const CrossingParts& parts, const EdgeEnds& edge);

}  // namespace bodice::cloth
