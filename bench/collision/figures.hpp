// The paper's figures 11 and 12 as tables.
#pragma once

#include <cstddef>

namespace bench {

/// Prints both figures, with bodies of up to `largest_body` vertices. False if the frame time varies by more
/// than 10 % over the bodies, or grows faster than the particles by more than that.
bool draw_figures(std::size_t largest_body);

}  // namespace bench
