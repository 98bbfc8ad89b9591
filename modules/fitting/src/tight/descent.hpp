// The anytime optimization of all ellipsoids of a proxy together.
#pragma once

#include <functional>

#include "tight/damped_step.hpp"
#include "tight/least_squares_problem.hpp"

namespace bodice::fitting {

struct DescentOptions {
  int iterations = 48;   ///< unless time is out or nothing is left to gain
  bool relocate = true;  ///< false: no ellipsoid is moved elsewhere, and samples are asked for once, at first
  double over_step = kOverStep;
  std::function<bool()> out_of_time;  ///< asked once an iteration
  /// Told of the ellipsoids when the cost has fallen by 5 % since the last time.
  std::function<void(std::span<const geometry::Ellipsoid>)> on_improved;
  /// Asked now and then for samples that the ellipsoids found so far need and the problem lacks.
  std::function<std::vector<DistanceSample>(std::span<const geometry::Ellipsoid>)> more_samples;
};

/// Lowers the cost of `ellipsoids` (in the problem's scaled units) in place; never raises it. Returns those
/// that hold no skin any more, ascending.
std::vector<std::size_t> descend(const engine::Context& context, TightProblem& problem,
                                 std::vector<geometry::Ellipsoid>& ellipsoids, const DescentOptions& options);

/// The descent moves ellipsoids to where they are needed, out of the part they started in: each takes the
/// part that most of its skin samples have (ties: the first part); one without skin keeps its own.
void take_parts(const TightProblem& problem, std::vector<proxy::ProxyEllipsoid>& ellipsoids);

}  // namespace bodice::fitting
