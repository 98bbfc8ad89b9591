#pragma once

#include "fit/measure.hpp"

namespace bodice::fitting {

/// Ellipsoids come in whole numbers: what the next coarser count misses by far, this one may beat by far.
/// Grows all ellipsoids by one length until the mean gap is the target, so that what the target leaves is
/// spent on skin that is covered. Does nothing if the gap is within a tenth of the target, above it or
/// under a third of it. A few measurements.
void spend_slack(const engine::Context& context, const LabeledSkin& skin, std::uint32_t parts,
                 double target_m, proxy::BodyProxy::Data& data, Measured& measured);

}  // namespace bodice::fitting
