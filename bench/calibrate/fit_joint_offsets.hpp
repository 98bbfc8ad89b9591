// The fit of the offsets of joints, which the layer rigging holds.
#pragma once

#include "fit.hpp"

namespace calibrate {

/// Least squares of what leads from a joint's origin to the true joint, along the axes of its offset frame
/// (rigging/src/joints/offset_joints.hpp), as fractions of what the axes measure.
ordered_json fit_joint_offsets(const Samples& samples);

}  // namespace calibrate
