// Tacks between pieces of one garment that lie on each other without a seam: straps, pockets or buttons of a
// file, or a bodice and a skirt that overlap.
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

/// The tacks of a garment, and the pieces that they hold.
struct Tacking {
  std::vector<cloth::Tack> tacks;   ///< pairs of vertices of the garment
  std::vector<TackedPiece> pieces;  ///< sorted by piece, then by the piece below it
};

/// Finds the tacks between pieces of a garment that lie within `within_m` of each other. Each vertex of a
/// piece's rim is tacked to the triangle nearest to it; a small piece, such as a button, is tacked at all its
/// vertices. Large pieces are tacked at seams only. A rim is a seam if a third of it lies on another piece,
/// or three fifths of it on another layer of its own piece that ends there as well. Nothing is tacked with a
/// distance of 0. Deterministic. Cost: a closest point for each vertex of a rim, microseconds, and the
/// distances along the cloth near it.
Tacking find_tacks(const engine::Context& context, const geometry::TriMesh& garment, double within_m);

}  // namespace bodice::tryon
