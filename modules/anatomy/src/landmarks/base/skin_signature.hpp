// Landmarks on the skin that need nothing but a signature of the body's coordinates.
#pragma once

#include "coordinates/build.hpp"
#include "coordinates/signature.hpp"
#include "landmarks/base/landmark_kind.hpp"

namespace bodice::inline v0_1::anatomy {

inline constexpr int kBuildCount = static_cast<int>(std::tuple_size_v<Build>);
/// The features are all coordinates of a vertex, and what they follow is the build of the body.
using SkinSignature = Signature<kCoordinateCount, kBuildCount>;

/// The landmark with this signature on one side. Its confidence is that of its Mahalanobis distance. O(#V).
FoundLandmark find_by_signature(const LandmarkInput& input, LandmarkId left, int side,
                                const SkinSignature& signature);

}  // namespace bodice::anatomy
