// The last step of every cut: off the skin by the ease.
#pragma once

#include "garment/tailor.hpp"

namespace bodice::synth {

/// Moves vertices off the skin until each keeps the ease and the middle of each triangle is outside, and
/// eases what lies around them along. False if that cannot be had in a bounded number of passes: there is no
/// room.
bool keep_ease(const engine::Context& context, const Fitting& fitting, Cut& cut);

}  // namespace bodice::synth
