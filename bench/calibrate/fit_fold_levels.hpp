// The fit of where armpits and crotch are expected by the proportions of a body.
#pragma once

#include "fit.hpp"

namespace calibrate {

/// Least squares of the levels of armpits and crotch by the other landmarks, all true, over adults that stand
/// with their arms down. The ridge is chosen on people left out; their errors are printed.
ordered_json fit_fold_levels(const Samples& samples);

}  // namespace calibrate
