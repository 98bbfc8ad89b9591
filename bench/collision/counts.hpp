// How the cost of a query and a response grows with the number of ellipsoids.
#pragma once

#include <cstddef>

namespace bench {

/// Prints a row a number of ellipsoids, up to 4,096.
void grow_counts(std::size_t particles, int repeats);

}  // namespace bench
