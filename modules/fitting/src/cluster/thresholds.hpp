#pragma once

namespace bodice::inline v0_1::fitting {

/// The paper's thresholds mu: one for the torso and one for the limbs.
struct Thresholds {
  double torso_m = 0.0, limbs_m = 0.0;  ///< 0: none, the number of ellipsoids decides where splitting stops

  bool given() const { return torso_m > 0.0 && limbs_m > 0.0; }
};

/// The torso's error may be larger than the limbs' by this factor, because its cross-sections are three times
/// wider.
inline constexpr double kTorsoToLimbs = 1.6;

}  // namespace bodice::fitting
