#pragma once

namespace bodice::fitting {

/// The paper's mu, one for the torso and one for the limbs.
struct Thresholds {
  double torso_m = 0.0, limbs_m = 0.0;  ///< 0: no threshold, the count decides

  bool given() const { return torso_m > 0.0 && limbs_m > 0.0; }
};

/// The torso may be this much worse than the limbs: its cross-sections are three times wider.
inline constexpr double kTorsoToLimbs = 1.6;

}  // namespace bodice::fitting
