#include "selfcontact/wrong_side.hpp"

#include <algorithm>
#include <limits>

#include "selfcontact/passage.hpp"

namespace bodice::inline v0_1::cloth {
namespace {

constexpr std::uint32_t kNoPart = std::numeric_limits<std::uint32_t>::max();
constexpr std::uint32_t kOutside = 0;  // the part of all particles that no line encloses
// A part with more than this share of the cloth's particles is outside.
constexpr double kLargestEnclosed = 0.125;

void add_piercings(const ContactMesh& mesh, std::uint32_t of, std::uint32_t face, std::span<const Point> at,
                   CrossingParts& parts) {
  const Face& f = mesh.faces[of];
  for_each_passage(f, mesh.faces[face], at, [&](unsigned k, const Passage&) {
    parts.piercings.push_back({ends_of(f.particle[k], f.particle[(k + 1) % 3]), face});
  });
}

// Finds the edges that pass through triangles. Each is found by both of its triangles.
void find_piercings(const ContactMesh& mesh, std::span<const Tangle> tangles, std::span<const Point> at,
                    CrossingParts& parts) {
  parts.piercings.clear(), parts.cut.clear();
  for (const Tangle& t : tangles)
    add_piercings(mesh, t.a, t.b, at, parts), add_piercings(mesh, t.b, t.a, at, parts);
  std::ranges::sort(parts.piercings);
  const auto repeated = std::ranges::unique(parts.piercings);
  parts.piercings.erase(repeated.begin(), repeated.end());
  for (std::size_t k = 0; k < parts.piercings.size();) {
    const std::size_t count = piercings_of(parts, parts.piercings[k].edge).size();
    if (count % 2 == 1) parts.cut.push_back(parts.piercings[k].edge);
    k += count;
  }
}

void find_line_ends(const ContactMesh& mesh, std::span<const Tangle> tangles, CrossingParts& parts) {
  parts.line_ends.clear();
  for (const Tangle& t : tangles)
    for (const Index i : mesh.faces[t.a].particle)
      if (contains(mesh.faces[t.b], i)) parts.line_ends.push_back(i);
  std::ranges::sort(parts.line_ends);
}

// Adds the particle `from` and all that edges connect with it, without a cut or an end of a line between, as
// a part. It is outside if it is large or if it meets the outside.
void add_part(const ContactMesh& mesh, Index from, CrossingParts& parts) {
  const auto own = static_cast<std::uint32_t>(parts.size.size());
  const std::size_t first = parts.reached.size();
  const auto most = static_cast<std::size_t>(kLargestEnclosed * static_cast<double>(parts.part.size()));
  bool outside = false;
  auto reach = [&](Index i) {
    outside = outside || parts.part[i] == kOutside;
    if (parts.part[i] != kNoPart) return;
    parts.part[i] = own;
    parts.reached.push_back(i);
  };
  reach(from);
  for (std::size_t k = first; k < parts.reached.size() && !outside; ++k) {
    const Index i = parts.reached[k];
    for (const std::uint32_t f : mesh.star_of(i))
      for (const Index j : mesh.faces[f].particle)
        if (j != i && !std::ranges::binary_search(parts.line_ends, j) &&
            !std::ranges::binary_search(parts.cut, ends_of(i, j)))
          reach(j);
    outside = outside || parts.reached.size() - first > most;
  }
  if (outside)
    for (std::size_t k = first; k < parts.reached.size(); ++k) parts.part[parts.reached[k]] = kOutside;
  parts.size.push_back(outside ? 0 : static_cast<std::uint32_t>(parts.reached.size() - first));
}

}  // namespace

CrossingParts make_crossing_parts(std::size_t particles) {
  CrossingParts parts;
  parts.part.assign(particles, kNoPart);
  return parts;
}

void find_crossing_parts(const ContactMesh& mesh, std::span<const Tangle> tangles, std::span<const Point> at,
                         CrossingParts& parts) {
  for (const Index i : parts.reached) parts.part[i] = kNoPart;
  parts.reached.clear();
  parts.size.assign(1, kNoPart);
  find_piercings(mesh, tangles, at, parts);
  find_line_ends(mesh, tangles, parts);
  for (const EdgeEnds& cut : parts.cut)
    for (const Index i : {cut.p, cut.q})
      if (parts.part[i] == kNoPart) add_part(mesh, i, parts);
  parts.beyond.assign(parts.size.size(), 0);
  for (const EdgeEnds& cut : parts.cut) {
    const std::uint32_t a = parts.part[cut.p], b = parts.part[cut.q];
    if (a == b) continue;
    if (parts.size[a] <= parts.size[b]) parts.beyond[a] = 1;
    if (parts.size[b] <= parts.size[a]) parts.beyond[b] = 1;
  }
}

bool is_beyond(const CrossingParts& parts, Index i) {
  return parts.part[i] != kNoPart && parts.beyond[parts.part[i]] != 0;
}

std::span<const Piercing> piercings_of(const CrossingParts& parts, const EdgeEnds& edge) {
  const auto range = std::ranges::equal_range(parts.piercings, edge, {}, &Piercing::edge);
  return {range.begin(), range.end()};
}

}  // namespace bodice::cloth
