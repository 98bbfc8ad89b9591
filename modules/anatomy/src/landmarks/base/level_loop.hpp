// Loops at fitted levels of the trunk and of limbs, without corrections.
#pragma once

#include <span>

#include "coordinates/build.hpp"
#include "landmarks/base/border_loop.hpp"

namespace bodice::inline v0_1::anatomy {

/// The number of coefficients of a level: a weight for each coordinate, a constant, and what each measure of
/// the build adds to that constant.
inline constexpr std::size_t kLevelCoefficients = kCoordinateCount + 1 + std::tuple_size_v<Build>;
using LevelCoefficients = std::span<const double, kLevelCoefficients>;

/// The border that the coefficients give on a body of this build.
Border level_border(LevelCoefficients coefficients, const Build& build);

/// The loop around a limb at the level, with the landmark at its center. O(#V + #F).
FoundLandmark find_limb_level(const LandmarkInput& input, LandmarkId left, int side, Coordinate end,
                              float reach, LevelCoefficients coefficients);

/// The loop around the trunk at the level, with the landmark at its center. The level is the same for a body
/// and its mirror image. O(#V + #F).
FoundLandmark find_trunk_level(const LandmarkInput& input, LandmarkId id, LevelCoefficients coefficients);

}  // namespace bodice::anatomy
