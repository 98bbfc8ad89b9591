// Finds triangles that cross, and draws them apart. They cross when the simulation begins, or because the
// body pressed them together, and contact does not act between them (loose.hpp). Where an edge passes through
// a triangle, both are moved so that the line along which the surfaces cross becomes shorter, until it is
// gone.
// Based on: Pascal Volino, Nadia Magnenat-Thalmann. Resolving Surface Collisions through Intersection Contour
// Minimization. 2006. - section 3
// Differs: the gradient is that of the triangles' own piece of the line, without its neighbors'. No particle
// moves farther than the step.
#pragma once

#include <vector>

#include "pairs/pairs.hpp"
#include "selfcontact/loose.hpp"

namespace bodice::inline v0_1::cloth {

/// Finds all pairs of triangles that cross at positions `at`, sorted. The boxes of `tree` fit these.
void find_tangles(const engine::Context& context, const ContactMesh& mesh, const SweepTree& tree,
                  std::span<const Point> at, std::vector<PairTask>& tasks, std::vector<Tangle>& tangles);

/// Adds the tangles at positions `at` around the pairs that the tasks list as pressed; returns whether there
/// are any.
bool add_pressed(const ContactMesh& mesh, const std::vector<PairTask>& tasks, std::span<const Point> at,
                 std::vector<Tangle>& tangles);

/// How triangles that cross are moved.
struct Untangling {
  std::span<const std::uint8_t> touching;  ///< #P: whether the particle lies on the body
  std::span<const float> inverse_mass;     ///< #P: 0 for a pin, which stays, even if contact may move it
  const Loose& loose;                      ///< what is loose around these tangles
  float step_m = 0.0f;                     ///< how far each triangle is moved, and a particle at most
};

/// Moves the triangles of all tangles that still cross. Two triangles that both lie on the body stay where
/// they are, unless one has a particle that is known to be on the wrong side. A particle in many tangles
/// moves no farther than `how.step_m`, because the sum of their steps would tear the cloth. `room` (#P) is
/// scratch.
void untangle(const ContactMesh& mesh, const std::vector<Tangle>& tangles, const Untangling& how,
              std::span<Point> room, std::span<Point> at);

}  // namespace bodice::cloth
