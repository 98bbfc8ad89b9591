#pragma once

#include <bodice/engine/context.hpp>

namespace fit_bench {

/// One row a (vertices, tier): milliseconds, and the power of the vertices by which they grew since the row
/// before (the bar: at most one, on the whole). False if a fit fails.
bool print_growth(const bodice::engine::Context& context);

}  // namespace fit_bench
