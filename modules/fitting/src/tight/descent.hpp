// The anytime optimization of all ellipsoids of a proxy together.
#pragma once

#include <functional>

#include "tight/damped_step.hpp"
#include "tight/least_squares_problem.hpp"

namespace bodice::inline v0_1::fitting {

/// How a descent runs and when it ends.
struct DescentOptions {
  int iterations = 48;  ///< at most; it ends earlier if time is out or nothing is left to gain
  /// Whether split-and-merge moves are tried. Without them more_samples is called only before the first
  /// iteration.
  bool split_and_merge = true;
  double over_step = kOverStep;       ///< over-relaxation of the steps
  std::function<bool()> out_of_time;  ///< called once an iteration; may be empty
  /// Called with the ellipsoids when the cost fell by 5 % since the last call; may be empty.
  std::function<void(std::span<const geometry::Ellipsoid>)> on_improved;
  /// Called before the first iteration and before moves; returns samples that these ellipsoids need and the
  /// problem lacks. May be empty.
  std::function<std::vector<DistanceSample>(std::span<const geometry::Ellipsoid>)> more_samples;
};

/// Lowers the cost of `ellipsoids` (in the problem's scaled units) in place; it never rises. Returns the
/// indices of those that hold no skin any more, ascending.
std::vector<std::size_t> descend(const engine::Context& context, LeastSquaresProblem& problem,
                                 std::vector<geometry::Ellipsoid>& ellipsoids, const DescentOptions& options);

/// Gives each ellipsoid the part of most of its skin samples (on a tie, the first part), because a descent
/// may move it out of the part that it started in. An ellipsoid without skin keeps its part.
void take_parts(const LeastSquaresProblem& problem, std::vector<proxy::ProxyEllipsoid>& ellipsoids);

}  // namespace bodice::fitting
