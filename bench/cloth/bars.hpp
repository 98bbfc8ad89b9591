#pragma once

namespace bench {

/// What a frame may cost, with what it costs here beside it.
void print_bars();

}  // namespace bench
