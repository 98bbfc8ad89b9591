// The same query on every instruction set of the machine.
#pragma once

#include <functional>
#include <string>

namespace bench {

/// Prints a row for each target: least nanoseconds a particle, and the ratio to the best target (bar for
/// AVX2: 1.6).
void compare_targets(const std::string& name, const std::function<void()>& query, double particles,
                     int repeats);

}  // namespace bench
