// What holds a garment on a body.
#pragma once

#include <vector>

#include <bodice/geometry/tri_mesh.hpp>
#include <bodice/tryon/prepare.hpp>

namespace bodice::tryon {

/// Vertices that the wearer holds. A piece that reaches over the armpits rests on the shoulders and needs no
/// help; one that does not (a skirt, trousers) is held by its waistband: the boundary loop nearest the head,
/// as elastic or a belt would. Pieces that lie nowhere near the body are not held.
std::vector<geometry::Index> held_vertices(const geometry::TriMesh& garment, const SegmentedSkin& body);

}  // namespace bodice::tryon
