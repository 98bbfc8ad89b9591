// Split-and-merge moves: ellipsoids move from where they are hardly needed to where they gain most.
#pragma once

#include <vector>

#include "tight/least_squares_problem.hpp"

namespace bodice::inline v0_1::fitting {

/// Merges two neighbors, or removes an ellipsoid that is hardly needed, and splits another in two with the
/// one that this frees, wherever that lowers the cost. Returns the indices of the ellipsoids that changed,
/// none if no move pays. The problem is not changed; refresh it afterward. Costs about as much as twenty
/// steps of the descent.
std::vector<std::size_t> split_and_merge(const engine::Context& context, const LeastSquaresProblem& problem,
                                         std::vector<geometry::Ellipsoid>& ellipsoids);

/// #E x up to 3: the ellipsoids that are second nearest to most of an ellipsoid's own samples, the most
/// frequent first, the lower index first on a tie. `ranked` has the nearest ellipsoids of each sample; an
/// index of `count` or more stands for none. Time and memory are linear in the samples and in the ellipsoids.
std::vector<std::vector<std::uint32_t>> frequent_neighbors(std::span<const Nearest3> ranked,
                                                           std::size_t count);

}  // namespace bodice::fitting
