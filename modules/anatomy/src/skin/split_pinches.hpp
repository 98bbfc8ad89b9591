// Skins that touch themselves in single vertices.
#pragma once

#include "skin/skin.hpp"

namespace bodice::inline v0_1::anatomy {

/// A skin in which a vertex that joins separate fans of triangles (a hand that touches a thigh, welded) is
/// one vertex a fan, so that no path along the skin leads through the pinch.
struct SplitSkin {
  geometry::TriMesh mesh;               ///< the input's vertices first; the copies behind them
  std::vector<geometry::Index> origin;  ///< #copies: the vertex that each copy stands for
};

/// Splits the pinches of a skin. Makes no copies if there is no pinch, or where edges are shared by more than
/// two triangles. O(#F).
SplitSkin split_pinches(const Skin& skin);

/// Whether the numbers of vertices, edges and triangles are those of closed pieces without a pinch, so that
/// none has to be searched for.
bool surely_unpinched(const Skin& skin);

}  // namespace bodice::anatomy
