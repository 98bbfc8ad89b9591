// Triangles that stick out of a skin.
#pragma once

#include "skin.hpp"

namespace bodice::anatomy {

/// The mesh without its fins: triangles that hang on an edge where the skin already has two and are open on
/// another side. Their tips are no ends of a body, and ways along them lead across it. All vertices stay.
/// O(#F).
geometry::TriMesh drop_fins(const Skin& skin);

}  // namespace bodice::anatomy
