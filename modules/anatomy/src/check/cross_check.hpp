// Landmarks once more, by ways that use no table of where they lie: what the first ways are checked against.
#pragma once

#include "landmarks/landmarks.hpp"

namespace bodice::anatomy {

/// How far the second way's answer lies from the first's, of the size; negative where it has no answer.
struct CrossCheck {
  double neck = -1.0;      ///< center of the least girth between head and shoulders, as in the paper
  double perineum = -1.0;  ///< where the legs' loops merge
  std::array<double, 2> armpit{-1.0, -1.0};  ///< level where the loop around the arm widens into the trunk
  double armpits = -1.0;  ///< how much farther one armpit lies from its fingertip than the other
  double crown = -1.0;    ///< farthest from the perineum
  std::array<double, 2> fingertip{-1.0, -1.0}, toe{-1.0, -1.0};  ///< the same
  std::array<double, 2> elbow{-1.0, -1.0}, knee{-1.0, -1.0};     ///< bend of the limb's axis, or proportion
};

CrossCheck cross_check(const engine::Context& context, const Skin& skin, const BodyCoordinates& coordinates,
                       const Landmarks& marks);

/// A first answer's confidence after the second: apart by this much or more (of the size) leaves nothing; no
/// second answer halves it.
double checked_confidence(double confidence, double apart, double most);

/// Apart by this much, of the size, the two ways contradict each other. The neck's two ways mean its joint
/// and its narrowest place, which lie some 4 % apart. Each bound is passed by one of a hundred or fewer
/// places that are right.
inline constexpr double kMaxNeckDifference = 0.10, kMaxPerineumDifference = 0.085,
                        kMaxArmpitDifference = 0.08, kMaxCrownDifference = 0.06, kMaxArmpitAsymmetry = 0.08,
                        kMaxFingertipDifference = 0.02, kMaxToeDifference = 0.035, kMaxElbowDifference = 0.07,
                        kMaxKneeDifference = 0.038;
/// Below this confidence a place is named in a warning.
inline constexpr double kUncertain = 0.35;

}  // namespace bodice::anatomy
