// Garments that are made for a body, and the vertices that the body holds.
#pragma once

#include <vector>

#include <bodice/geometry/tri_mesh.hpp>
#include <bodice/synth/garment.hpp>
#include <bodice/tryon/prepare.hpp>
#include <bodice/tryon/wardrobe.hpp>

namespace bodice::inline v0_1::tryon {

/// A garment cut to this skin, named by its kind; the body holds it by its waistband, if it has one. Fails
/// and costs as synth::make_garment().
engine::Result<WornGarment> make_garment(const engine::Context& context, const SegmentedSkin& skin,
                                         const synth::GarmentOptions& options = {});

/// The vertices of a garment that stay with the body. A piece that reaches above the armpits rests on the
/// shoulders and has none. A lower piece (a skirt, trousers) is held at its waistband, the boundary loop
/// closest to the head, as by elastic or a belt. Pieces far from the body are not held. Cost: a closest point
/// a vertex.
std::vector<geometry::Index> held_vertices(const geometry::TriMesh& garment, const SegmentedSkin& body);

}  // namespace bodice::tryon
