#pragma once

#include <bodice/io/import.hpp>

namespace bodice::inline v0_1::tryon {

/// Splits the long edges of a thing at their middles until its triangles are small compared with it. Parts
/// and samples of a skin are found at vertices, of which a board of twelve triangles has too few. The surface
/// and the windings stay the same, and old vertices keep their numbers.
void refine_thing(io::ImportedMesh& thing);

}  // namespace bodice::tryon
