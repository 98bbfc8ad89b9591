// The fit of corrections.
#pragma once

#include <map>

#include "fit.hpp"

namespace calibrate {

/// The coefficients of each landmark's corrections, and the limits of its measures. One correction is fitted
/// after the other, and all bodies are measured again before each, because it starts where those before it
/// end. Errors count by their length, not by its square, and each group of bodies alike.
std::map<const bodice::anatomy::LandmarkKind*, ordered_json> fit_corrections(
    const std::vector<const bodice::anatomy::LandmarkKind*>& kinds, const Samples& samples);

}  // namespace calibrate
