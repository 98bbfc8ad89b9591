// The questions that bench/fit answers. Each prints CSV and returns false if a fit fails.
#pragma once

#include "subjects.hpp"

namespace fit_bench {

/// A line for each body, tier and count: the fit's own report, the error of the signed distance within 30 mm
/// of the skin, and the time of a query. Also writes the plot, if a file is given.
bool print_front(const bodice::engine::Context& context, const Arguments& arguments);

/// A line for each body and target or budget; the last line counts those met within a fifth.
bool print_targets(const bodice::engine::Context& context, const Arguments& arguments);

/// Every tier with 89 ellipsoids beside its bars, with the worst body; false as well if a bar is missed.
bool print_bars(const bodice::engine::Context& context, const Arguments& arguments);

/// The constants of the target search (modules/fitting/src/plan/plan.cpp), tier by tier: a line through the
/// logarithms of gap = at_89 stature (89 / count)^power for counts from 16 up, with its worst residual.
bool print_gap_formula(const bodice::engine::Context& context, const Arguments& arguments);

/// A line for each proxy that an anytime tier publishes: milliseconds since the fit began, and its error near
/// the skin. The last line states when half of the gain over the start was reached (the bar for tight: 100
/// ms).
bool print_anytime(const bodice::engine::Context& context, const Arguments& arguments);

/// A line for each number of vertices and tier: milliseconds, and the power of the vertices by which they
/// grew since the line before (the bar: at most one, over the whole range).
bool print_growth(const bodice::engine::Context& context);

}  // namespace fit_bench
