// One view of one moment.
#pragma once

#include "png.hpp"
#include "stage.hpp"

namespace bodice::io {

enum class Side { kFront, kLeft };

/// Draws into the image's rectangle at (x, y). `box` is what must fit; the ground is its bottom.
void draw_panel(const std::vector<Actor>& actors, const Lighting& lighting, const geometry::Box& box, Side side,
                int width, int height, int x, int y, Image& image);

}  // namespace bodice::io
