// The measurements of a made body, taken on its rest pose; those of thighs with the legs of the A pose.
#pragma once

#include <bodice/body/measurement.hpp>

#include "pose/truth.hpp"

namespace bodice::inline v0_1::synth {

/// All measurements of the standing body in units of stature, angles in radians, by the definitions of
/// modules/anatomy/README.md; arm_pose_angle is that of the pose. `landmarks`: of the posed body.
body::Measurements true_measurements(const Posed& body, const std::vector<body::Landmark>& landmarks);

}  // namespace bodice::synth
