// Hair that a scanner takes for skin.
#pragma once

#include <bodice/engine/random.hpp>
#include <bodice/synth/body.hpp>

#include "scan/solid.hpp"

namespace bodice::inline v0_1::synth {

/// A bun of random size, from a knot on top of the head to one low at its back. Precondition of both: the
/// head is upright and faces +z.
Solid hair_in_a_bun(const Body& body, engine::Random& random);

/// Hair that hangs down behind: a cap over the head's upper back, and a curtain from there to between the
/// shoulders and the waist. `skin` is the body's signed distance.
Solid hair_that_hangs(const Body& body, const geometry::DistanceField& skin, engine::Random& random);

}  // namespace bodice::synth
