// Armpits that are too low, and a crotch that is too high, by two kinds of weak evidence together: the limbs,
// and the room inside the body.
#pragma once

#include <array>

#include "walls/webs.hpp"

namespace bodice::inline v0_1::anatomy {

/// How far the left and the right armpit must be moved up, as fractions of the stature; 0 without sufficient
/// evidence. The target is the middle between two predictions: by limbs and trunk, and by the room inside the
/// body.
std::array<double, 2> armpits_too_low(const engine::Context& context, const geometry::TriMesh& skin,
                                      const Anatomy& found);

/// Warns of armpits that are still too low, on a skin that is not cut.
void doubt_low_armpits(const engine::Context& context, const geometry::TriMesh& skin, Anatomy& anatomy);

/// Doubts armpits of a body that was cut apart, by the room inside `skin` alone: they lie much too low.
void doubt_armpits_by_room(const engine::Context& context, const geometry::TriMesh& skin, Anatomy& anatomy);

/// Doubts the crotch of a body that was cut apart, if limbs, trunk and the room inside `skin` together have
/// it lower: a wall went too far up.
void doubt_high_crotch(const engine::Context& context, const geometry::TriMesh& skin, Anatomy& anatomy);

}  // namespace bodice::anatomy
