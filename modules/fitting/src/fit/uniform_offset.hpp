#pragma once

#include "fit/measure.hpp"

namespace bodice::inline v0_1::fitting {

/// Grows all ellipsoids by one length (the uniform offset) until the mean gap is the target. Counts are whole
/// numbers, so that one count may miss a target by far and the next beat it by far; growing then covers more
/// skin. Does nothing if the gap is above the target, within a tenth of it, or less than a third of it. Costs
/// up to ten measurements.
void grow_to_target(const engine::Context& context, const LabeledSkin& skin, std::uint32_t parts,
                    double target_m, proxy::BodyProxy::Data& data, Measured& measured);

}  // namespace bodice::fitting
