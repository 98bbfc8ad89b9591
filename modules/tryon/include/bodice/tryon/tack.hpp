// Pieces of one garment that lie on each other and no seam joins: a file's straps, pockets, buttons, or a
// bodice and a skirt that overlap.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <bodice/cloth/solver.hpp>
#include <bodice/engine/context.hpp>
#include <bodice/geometry/tri_mesh.hpp>

namespace bodice::inline v0_1::tryon {

/// The distance up to which pieces are tacked where none is given, meters: that of two layers that touch.
inline constexpr double kTackWithin_m = 0.006;

/// A piece of a garment that was tacked to another one. Pieces are numbered from 1 by falling area.
struct TackedPiece {
  std::size_t piece = 0, onto = 0;
  std::size_t points = 0;  ///< vertices of the piece that threads hold
};

/// What holds the pieces of a garment together.
struct Tacking {
  std::vector<cloth::Tack> tacks;   ///< pairs of vertices of the garment
  std::vector<TackedPiece> pieces;  ///< by piece, then by what it lies on
};

/// Finds where pieces of a garment lie within `within_m` of another one. The rim of a piece is tacked to the
/// triangle that each of its vertices is nearest to, and a small piece, such as a button, at all its
/// vertices. Large pieces are tacked only at seams: rims that lie on another piece for a third of their
/// length, or on another layer of their own piece that ends there, too, for three fifths.
/// Nothing is tacked with a distance of 0. Deterministic. Cost: a closest point for each vertex of a rim,
/// microseconds, and the distances along the cloth near it.
Tacking find_tacks(const engine::Context& context, const geometry::TriMesh& garment, double within_m);

}  // namespace bodice::tryon
