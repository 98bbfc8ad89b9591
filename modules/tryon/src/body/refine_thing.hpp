#pragma once

#include <bodice/io/import.hpp>

namespace bodice::inline v0_1::tryon {

/// Splits the long edges of a thing at their middles until its triangles are small beside it: boards of
/// twelve triangles become parts and samples of the skin only by their vertices. The surface stays the same,
/// old vertices keep their numbers, and triangles are wound as before.
void refine_thing(io::ImportedMesh& thing);

}  // namespace bodice::tryon
