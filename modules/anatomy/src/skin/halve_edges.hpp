// Coarse skins, made finer for the analysis.
#pragma once

#include "skin/skin.hpp"

namespace bodice::inline v0_1::anatomy {

/// Every triangle cut into four at the middles of its edges; the surface stays the same. The input's vertices
/// come first.
struct FinerSkin {
  geometry::TriMesh mesh;
  std::vector<geometry::Index> origin;  ///< #E: an end of the edge that each new vertex halves
};

/// O(#V + #F).
FinerSkin halve_edges(const Skin& skin);

/// A calf of a skin with fewer vertices has ten or fewer around: paths along its edges spiral.
inline constexpr std::size_t kCoarse = 3000;
/// Nothing with fewer vertices shows a head, hands and feet, however fine it is made.
inline constexpr std::size_t kNoBody = 100;

}  // namespace bodice::anatomy
