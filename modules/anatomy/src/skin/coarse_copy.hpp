// Fine skins, made coarser for the analysis.
#pragma once

#include <optional>

#include <bodice/engine/context.hpp>
#include <bodice/geometry/tri_mesh.hpp>

namespace bodice::anatomy {

/// A skin of fewer triangles between some of a skin's own vertices.
struct CoarseCopy {
  geometry::TriMesh mesh;
  std::vector<geometry::Index> origin;   ///< of each of its vertices: the same vertex of the skin
  std::vector<geometry::Index> nearest;  ///< #V: the copy's vertex of the patch that each vertex lies in
};

/// Skins with more vertices than this are analyzed on a copy: steps of the analysis take a millimeter or
/// more.
inline constexpr std::size_t kFine = 150000;

/// A copy with some hundred thousand vertices. The skin's vertices form patches along the surface, so that
/// sheets which lie close stay apart; triangles join patches that meet in one. Nothing where the copy is no
/// surface: there the skin has flaws of its own. O(#V + #F).
std::optional<CoarseCopy> coarse_copy(const engine::Context& context, const geometry::TriMesh& skin);

}  // namespace bodice::anatomy
