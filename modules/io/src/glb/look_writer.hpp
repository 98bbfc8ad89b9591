// Materials of a garment's file in a GLB, with their textures and images.
#pragma once

#include <vector>

#include "../look/look.hpp"
#include "glb_builder.hpp"

namespace bodice::inline v0_1::io {

/// Adds all materials; returns the index of each in the document.
std::vector<std::size_t> add_materials(const Materials& materials, GlbBuilder& glb);

}  // namespace bodice::io
