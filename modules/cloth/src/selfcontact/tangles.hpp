// Triangles that cross when the simulation begins, or because the body pressed them together, and how they
// come apart. Contact leaves them alone (loose.hpp); where an edge passes through a triangle, the two are
// moved so that the line along which the surfaces cross becomes shorter, until it is gone.
// Based on: Pascal Volino, Nadia Magnenat-Thalmann. Resolving Surface Collisions through Intersection Contour
// Minimization. 2006. - section 3
// Differs: the gradient is that of the triangles' own piece of the line, without its neighbors'. No particle
// moves farther than the step.
#pragma once

#include <vector>

#include "selfcontact/pairs.hpp"

namespace bodice::cloth {

/// Finds all pairs of triangles that cross at positions `at`, sorted. The boxes of `tree` fit these.
void find_tangles(const engine::Context& context, const ContactMesh& mesh, const SweepTree& tree,
                  std::span<const Point> at, std::vector<PairTask>& tasks, std::vector<Tangle>& tangles);

/// Updates the tangles after some motion. Looks at the neighbors of those that there were, because contact
/// lets nothing cross elsewhere. `room` has what they were.
void follow_tangles(const ContactMesh& mesh, std::span<const Point> at, std::vector<Tangle>& tangles,
                    std::vector<Tangle>& room);

/// Adds the triangles that cross at positions `at` of the pairs that the tasks list as pressed; returns
/// whether there are any.
bool add_pressed(const ContactMesh& mesh, const std::vector<PairTask>& tasks, std::span<const Point> at,
                 std::vector<Tangle>& tangles);

/// Moves the triangles of all tangles by about `step_m` each, where they still cross. Two that
/// lie on the body stay where it has them. touching   #P
void untangle(const ContactMesh& mesh, const std::vector<Tangle>& tangles,
              std::span<const std::uint8_t> touching, float step_m, std::span<Point> at);

}  // namespace bodice::cloth
