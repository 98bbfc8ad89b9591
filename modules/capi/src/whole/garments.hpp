// Garments of the host.
#pragma once

#include <vector>

#include <bodice/tryon/wardrobe.hpp>

#include "arrays/strided.hpp"
#include "base/outcome.hpp"

namespace bodice::inline v0_1::capi {

/// Copies an array of garments; names the garment and the element at fault.
Outcome read_garments(const bodice_garment* given, std::size_t count, std::vector<tryon::WornGarment>& out);

/// The fabric of this name; null is cotton.
Outcome read_fabric(const char* name, std::optional<cloth::Fabric>& out);

/// Checks arrays of the host for `count` positions to be written.
Outcome read_positions(const bodice_vectors* given, std::size_t count, StridedVectors& out);

}  // namespace bodice::capi
