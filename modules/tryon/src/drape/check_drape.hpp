// Whether the options of a drape are in their ranges.
#pragma once

#include <vector>

#include <bodice/tryon/drape.hpp>

namespace bodice::inline v0_1::tryon {

/// Fails with kInvalidArgument, naming the option and its range.
engine::Result<void> check(const DrapeOptions& options, const PreparedBody& body);

/// Fails with kInvalidArgument and names a garment that is the body's own skin. Contact would press its
/// layers together from the first frame on, at minutes a frame. Cost: a closest point for a few vertices of a
/// garment, for all of the skin itself. Precondition: triangles refer to existing vertices.
engine::Result<void> check(const std::vector<WornGarment>& garments, const PreparedBody& body);

}  // namespace bodice::tryon
