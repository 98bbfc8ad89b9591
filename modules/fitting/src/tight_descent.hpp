// The anytime optimisation of all ellipsoids of a proxy together.
#pragma once

#include <functional>

#include "tight_problem.hpp"

namespace bodice::fitting {

struct DescentOptions {
  int max_iterations = 500;
  bool relocate = true;  ///< false: ellipsoids stay where they are needed, and samples are asked for once
  /// Ends when this much of the cost is not gained over 48 iterations.
  double least_gain = 0.005;
  std::function<bool()> out_of_time;  ///< asked once an iteration
  /// Told of the ellipsoids when the cost has fallen by 5 % since the last time.
  std::function<void(std::span<const geometry::Ellipsoid>)> on_improved;
  /// Asked now and then for samples that the ellipsoids found so far need and the problem lacks.
  std::function<std::vector<DistanceSample>(std::span<const geometry::Ellipsoid>)> more_samples;
};

struct DescentReport {
  int iterations = 0;
  double first_cost = 0.0, last_cost = 0.0;
  std::vector<std::size_t> idle;  ///< ellipsoids that hold no skin any more, ascending
  bool converged = false;         ///< stopped because nothing was gained any more
};

/// Lowers the cost of `ellipsoids` (in the problem's scaled units) in place; never raises it.
DescentReport descend(const engine::Context& context, TightProblem& problem,
                      std::vector<geometry::Ellipsoid>& ellipsoids, const DescentOptions& options);

/// The descent moves ellipsoids to where they are needed, out of the part they started in: each takes the
/// part that most of its skin samples have (ties: the first part); one without skin keeps its own.
void take_parts(const TightProblem& problem, std::vector<proxy::ProxyEllipsoid>& ellipsoids);

}  // namespace bodice::fitting
