#pragma once

namespace bench {

/// Prints the bars on a frame's time, with the measured times beside them.
void print_bars();

}  // namespace bench
