// Moves of ellipsoids from where they are hardly needed to where they gain most.
#pragma once

#include <vector>

#include "tight/least_squares_problem.hpp"

namespace bodice::fitting {

/// Two neighbors become one, or one that is hardly needed goes, and the ellipsoid that this frees becomes
/// half of another, wherever that lowers the cost. Returns which ellipsoids changed: none if no such move
/// pays. The problem stays as it is: refresh it. Costs about as much as twenty steps of the descent.
std::vector<std::size_t> relocate(const engine::Context& context, const TightProblem& problem,
                                  std::vector<geometry::Ellipsoid>& ellipsoids);

}  // namespace bodice::fitting
