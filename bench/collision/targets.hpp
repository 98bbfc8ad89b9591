// The same question on every instruction set that the machine has.
#pragma once

#include <functional>
#include <string>

namespace bench {

/// Prints a row a target: least nanoseconds a particle, and the ratio to the best target (bar for AVX2: 1.6).
void compare_targets(const std::string& name, const std::function<void()>& query, double particles,
                     int repeats);

}  // namespace bench
