// Growth of the cost of a query and of a response with the number of ellipsoids.
#pragma once

#include <cstddef>

namespace bench {

/// Prints a row for each number of ellipsoids, up to 4,096.
void grow_counts(std::size_t particles, int repeats);

}  // namespace bench
