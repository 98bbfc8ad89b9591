// Armpits that the room inside the body and the limbs have too low, neither enough by itself.
#pragma once

#include <array>

#include "walls/webs.hpp"

namespace bodice::inline v0_1::anatomy {

/// How far the left and the right armpit are to be moved up, as a fraction of the stature: to the middle
/// between where limbs and trunk let expect it and where the room inside the body shows its fold. 0 where
/// both together are no evidence.
std::array<double, 2> armpits_too_low(const engine::Context& context, const geometry::TriMesh& skin,
                                      const Anatomy& found);

/// Doubts armpits that are still too low. `skin` is not cut.
void doubt_low_armpits(const engine::Context& context, const geometry::TriMesh& skin, Anatomy& anatomy);

}  // namespace bodice::anatomy
