// The fit of the borders between parts.
#pragma once

#include "fit.hpp"

namespace calibrate {

/// Least squares of the distance along the skin to the true border, over the skin near it: each border's
/// weights, and what a deviation of each measure of the build adds to them. The ridge is what errs least on
/// people left out.
ordered_json fit_part_borders(const Samples& samples);

/// The same for the borders through joints that landmarks read: one for all builds.
ordered_json fit_joint_borders(const Samples& samples);

}  // namespace calibrate
