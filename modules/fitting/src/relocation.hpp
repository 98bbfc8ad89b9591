// Moves of ellipsoids from where they are hardly needed to where the cost is largest.
#pragma once

#include <vector>

#include "tight_problem.hpp"

namespace bodice::fitting {

/// A search over moves: several at once while they pay, fewer after they did not, and never soon again one
/// that did not pay alone.
class Relocation {
 public:
  explicit Relocation(std::size_t ellipsoids);

  /// Puts the least useful ellipsoids onto halves of the costliest ones; returns which ellipsoids changed.
  std::vector<std::size_t> move(const TightProblem& problem, std::vector<geometry::Ellipsoid>& ellipsoids);
  /// Whether the last moves lowered the cost.
  void judge(bool paid);

 private:
  struct Move {
    std::size_t idle, costly;
  };

  int moves_;
  int round_ = 0;
  std::vector<int> barred_until_;  ///< #E: rounds until it may be split again
  std::vector<Move> last_;
};

}  // namespace bodice::fitting
