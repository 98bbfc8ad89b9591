#pragma once

#include <vector>

#include <bodice/tryon/prepare.hpp>
#include <bodice/tryon/wardrobe.hpp>

namespace bodice::inline v0_1::tryon {

/// Warns of garments that are far from the body or of another unit. Such a garment simulates without any
/// penetration, so that the rest of the report looks like success.
void warn_of_misplaced(const std::vector<WornGarment>& garments, const PreparedBody& body,
                       std::vector<engine::Warning>& warnings);

}  // namespace bodice::tryon
