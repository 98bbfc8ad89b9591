// Finds the vertices by which a body holds a garment.
#pragma once

#include <vector>

#include <bodice/geometry/tri_mesh.hpp>
#include <bodice/tryon/prepare.hpp>

namespace bodice::tryon {

/// The vertices that the wearer holds. A piece that reaches above the armpits rests on the shoulders and
/// needs none. A lower one (a skirt, trousers) is held by its waistband, the boundary loop closest to the
/// head, as by elastic or a belt. Pieces far from the body are not held.
std::vector<geometry::Index> held_vertices(const geometry::TriMesh& garment, const SegmentedSkin& body);

}  // namespace bodice::tryon
