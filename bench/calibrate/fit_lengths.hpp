// The fits to distances between extremities along the skin: the stature, and the template of extremities.
#pragma once

#include "fit.hpp"

namespace calibrate {

/// The least sum of errors of the stature by lengths along the skin, over bodies that do not stand. Each
/// group of bodies counts alike, but for those of files.
ordered_json fit_stature(const Samples& samples);

/// The mean distances of adults, as fractions of the stature, and the deviations of the template's modes that
/// explain how all bodies' distances spread around them.
ordered_json fit_extremities(const Samples& samples);

}  // namespace calibrate
