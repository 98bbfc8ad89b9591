// Each motion as postures over its phase, from 0 to 1.
#pragma once

#include "posture/posture.hpp"

namespace bodice::inline v0_1::rigging {

/// The lengths of a body that a motion uses, in lengths of the leg.
struct Build {
  double hip_half_width = 0.1;
  double thigh = 0.5, calf = 0.45;  ///< lengths of the bones
};

/// A posture with the feet flat below the hips and the arms hanging.
Posture standing(const Build& build);

/// The distance that a gait covers in one cycle, in lengths of the leg.
double walking_stride();
double running_stride();

Posture walk(double phase, const Build& build);
Posture run(double phase, const Build& build);
Posture turn(double phase, const Build& build);
Posture spin(double phase, const Build& build);
Posture reach(double phase, const Build& build);
Posture sit(double phase, const Build& build);
Posture squat(double phase, const Build& build);
Posture arms_up(double phase, const Build& build);
Posture dance(double phase, const Build& build);

}  // namespace bodice::rigging
