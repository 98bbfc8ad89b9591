#pragma once

#include <vector>

#include <bodice/tryon/prepare.hpp>
#include <bodice/tryon/wardrobe.hpp>

namespace bodice::inline v0_1::tryon {

/// Warns of garments that are far from the body or in another unit. They would penetrate nothing, so that the
/// rest of the report would look good.
void warn_of_misplaced(const std::vector<WornGarment>& garments, const PreparedBody& body,
                       std::vector<engine::Warning>& warnings);

}  // namespace bodice::tryon
