// All landmarks, each with a confidence that its cross-checks have lowered.
#pragma once

#include "landmarks/base/landmark_kind.hpp"

namespace bodice::inline v0_1::anatomy {

/// The differences that the cross-checks of each landmark measured, as fractions of the body size; negative
/// where there is no second estimate.
using Differences = std::array<std::array<double, 2>, body::kLandmarkCount>;

/// The landmarks of a body and how far their second estimates lie from them.
struct CheckedLandmarks {
  Landmarks marks;
  Differences differences;
};

/// Runs the steps of the table of landmarks. The same for any number of workers. `records`, if there are any,
/// take what corrections are computed from. O(#V + #F) a landmark.
CheckedLandmarks find_landmarks(const engine::Context& context, const Skin& skin,
                                const BodyCoordinates& coordinates, CorrectionRecords* records = nullptr);

/// The landmarks as users see them, in the order of LandmarkId; confidence 0 where nothing was found.
/// Vertices of landmarks on the skin are those nearest to where the landmarks ended up.
std::vector<body::Landmark> to_list(const Skin& skin, const Landmarks& marks);

/// A confidence after a second estimate at a distance of `difference`: nothing is left at `most` or more, and
/// half where there is no second estimate.
double checked_confidence(double confidence, double difference, double most);

}  // namespace bodice::anatomy
