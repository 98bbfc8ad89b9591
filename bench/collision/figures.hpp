// The paper's figures 11 and 12 as tables.
#pragma once

#include <cstddef>

namespace bench {

/// Prints both; bodies of up to `largest_body` vertices. False if the frame time is not flat within 10 %, or
/// grows faster than the particles by as much.
bool draw_figures(std::size_t largest_body);

}  // namespace bench
