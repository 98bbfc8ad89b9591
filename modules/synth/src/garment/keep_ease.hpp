// The last step of every cut moves it off the skin by the ease.
#pragma once

#include "garment/tailor.hpp"

namespace bodice::inline v0_1::synth {

/// Moves vertices off the skin until each keeps the ease and the middle of each triangle is outside, and
/// moves their surroundings along. Returns false if a bounded number of passes does not suffice, because
/// there is no room.
bool keep_ease(const engine::Context& context, const Fitting& fitting, Cut& cut);

}  // namespace bodice::synth
