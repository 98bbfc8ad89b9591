// The fits of the two signatures that have features of their own.
#pragma once

#include "fit.hpp"

namespace calibrate {

/// A signature that finds the landmark among the skin that it is searched in. `samples`: each body once.
ordered_json fit_armpit_signature(const Samples& samples);
ordered_json fit_perineum_signature(const Samples& samples);

}  // namespace calibrate
