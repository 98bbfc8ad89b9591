// The fit of corrections: how far landmarks lie from their first estimates.
#pragma once

#include "fit.hpp"

namespace calibrate {

/// Least squares of the vector from the first estimate to the true landmark, all axes of a correction
/// together. Members of the landmark's file that no correction names are absent. Prints the error before and
/// after, of bodies that were left out of the fit.
ordered_json fit_corrections(const bodice::anatomy::LandmarkKind& kind, const Samples& samples);

}  // namespace calibrate
