#include "selfcontact/loose.hpp"

namespace bodice::inline v0_1::cloth {
namespace {

void add_corner(Index i, Loose& loose) {
  if (!loose.is_corner[i]) loose.list.push_back(i);
  loose.is_corner[i] = 1;
}

void let_pass(Index i, Loose& loose) {
  add_corner(i, loose);
  loose.may_pass[i] = 1;
}

// Lets an edge and the triangles that it passes through pass each other, if no side is known. It is known
// where the other surface has a part on the wrong side there: then this one is on its own side.
void let_undecided_pass(const ContactMesh& mesh, const EdgeEnds& edge, Loose& loose) {
  const std::span<const Piercing> piercings = piercings_of(loose.parts, edge);
  for (const Piercing& piercing : piercings)
    for (const Index i : mesh.faces[piercing.face].particle)
      if (is_beyond(loose.parts, i)) return;
  let_pass(edge.p, loose), let_pass(edge.q, loose);
  for (const Piercing& piercing : piercings)
    for (const Index i : mesh.faces[piercing.face].particle) let_pass(i, loose);
}

bool edge_may_pass(Index p, Index q, const Loose& loose) {
  return loose.may_pass[p] || loose.may_pass[q] || !piercings_of(loose.parts, ends_of(p, q)).empty();
}

}  // namespace

Loose make_loose(std::size_t particles) {
  Loose loose;
  loose.parts = make_crossing_parts(particles);
  loose.is_corner.assign(particles, 0), loose.may_pass.assign(particles, 0);
  loose.list.reserve(particles);
  return loose;
}

void loosen(const ContactMesh& mesh, std::span<const Tangle> tangles, std::span<const Point> at,
            Loose& loose) {
  for (const Index i : loose.list) loose.is_corner[i] = loose.may_pass[i] = 0;
  loose.list.clear();
  for (const Tangle& t : tangles)
    for (const std::uint32_t face : {t.a, t.b})
      for (const Index i : mesh.faces[face].particle) add_corner(i, loose);
  find_crossing_parts(mesh, tangles, at, loose.parts);
  for (const Index i : loose.parts.reached)
    if (is_beyond(loose.parts, i)) let_pass(i, loose);
  for (const EdgeEnds& cut : loose.parts.cut)
    if (loose.parts.part[cut.p] == loose.parts.part[cut.q]) let_undecided_pass(mesh, cut, loose);
}

bool corners_are_loose(const Index (&particle)[4], bool edges, const Loose& loose) {
  if (!edges) return loose.may_pass[particle[0]] != 0;
  return edge_may_pass(particle[0], particle[1], loose) || edge_may_pass(particle[2], particle[3], loose);
}

}  // namespace bodice::cloth
