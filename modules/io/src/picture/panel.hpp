// One view of a scene at one time.
#pragma once

#include "png.hpp"
#include "stage.hpp"

namespace bodice::inline v0_1::io {

enum class Side { kFront, kLeft };

struct Rectangle {
  int x = 0, y = 0, width = 0, height = 0;  ///< pixels
};

/// Draws into the image's rectangle. The view shows the whole `box`; the ground is its bottom.
void draw_panel(const std::vector<Actor>& actors, const geometry::Box& box, Side side, const Rectangle& where,
                Image& image);

}  // namespace bodice::io
