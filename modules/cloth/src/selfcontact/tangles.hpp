// Triangles that cross when the simulation begins, or because the body pressed them together, and how they
// come apart. Their contacts have no sides; where an edge passes through a triangle, the two are moved so
// that the line along which the surfaces cross becomes shorter, until it is gone.
// Based on: Pascal Volino, Nadia Magnenat-Thalmann. Resolving Surface Collisions through Intersection Contour
// Minimization. 2006. - section 3
// Differs: the gradient is that of the triangles' own piece of the line, without its neighbors'.
#pragma once

#include <vector>

#include "selfcontact/pairs.hpp"

namespace bodice::cloth {

/// Finds all pairs of triangles that cross at positions `at`, sorted. The boxes of `tree` fit these.
void find_tangles(const engine::Context& context, const ContactMesh& mesh, const SweepTree& tree,
                  std::span<const Point> at, std::vector<PairTask>& tasks, std::vector<Tangle>& tangles);

/// Updates the tangles after some motion; true if they changed. Looks at the neighbors of those that there
/// were, because only there contacts have no sides. `room` has what they were.
bool follow_tangles(const ContactMesh& mesh, std::span<const Point> at, std::vector<Tangle>& tangles,
                    std::vector<Tangle>& room);

/// Moves the triangles of all tangles by about `step_m` each, where they still cross. Those that the
/// body presses together from both sides stay.
void untangle(const ContactMesh& mesh, const std::vector<Tangle>& tangles, const BodyPush& body, float step_m,
              std::span<Point> at);

}  // namespace bodice::cloth
