// The fits to distances between extremities along the skin: the stature, and the template of extremities.
#pragma once

#include "fit.hpp"

namespace calibrate {

/// Least squares of the relative error of the stature by head to feet, foot to foot, hand to hand and head to
/// hands.
ordered_json fit_stature(const Samples& samples);

/// The mean distances of adults, as fractions of the stature, and the deviations of the template's modes that
/// explain how all bodies' distances spread around them.
ordered_json fit_extremities(const Samples& samples);

}  // namespace calibrate
