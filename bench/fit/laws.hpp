// The constants of the dial (modules/fitting/src/plan.cpp), measured.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace fit_bench {

/// One fit: what it achieved and what its queries cost.
struct LawPoint {
  std::string tier;
  double ellipsoids = 0.0, gap_of_stature = 0.0, query_ns = 0.0;
};

/// Prints, a tier: gap = at_89 stature (89 / count)^power as a line through the logarithms, with its worst
/// residual, and query time = fixed + each count as a line, for the counts from 16 up.
void print_laws(const std::vector<LawPoint>& points);

}  // namespace fit_bench
