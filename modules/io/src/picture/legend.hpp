// A scale of colors below a picture.
#pragma once

#include <bodice/io/scene.hpp>

#include "png.hpp"

namespace bodice::inline v0_1::io {

/// Adds a strip below the image: a bar in the legend's colors, its numbers, and what its ends mean.
void add_legend(const Legend& legend, Image& image);

}  // namespace bodice::io
