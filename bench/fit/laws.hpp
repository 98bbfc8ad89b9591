// The constants of the dial (modules/fitting/src/plan.cpp), measured.
#pragma once

#include <string>
#include <vector>

namespace fit_bench {

/// One fit: what it achieved. (What queries cost, bench/tradeoff measures.)
struct LawPoint {
  std::string tier;
  double ellipsoids = 0.0, gap_of_stature = 0.0;
};

/// Prints, a tier: gap = at_89 stature (89 / count)^power as a line through the logarithms, with its worst
/// residual, for the counts from 16 up.
void print_laws(const std::vector<LawPoint>& points);

}  // namespace fit_bench
