// How far measurements of made bodies lie from the truth.
#pragma once

#include <cstdint>

namespace bench {

/// Prints the error of each measurement over `count` made bodies of seeds `from`, `from` + 1, ..., which
/// stand in the A pose; errors of landmarks stand in the table of --seeds.
void print_measurement_errors(std::uint64_t from, std::uint64_t count);

}  // namespace bench
