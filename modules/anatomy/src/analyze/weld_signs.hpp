// The signs of welded limbs among warnings, and the number of doubts.
#pragma once

#include <bodice/anatomy/anatomy.hpp>

namespace bodice::inline v0_1::anatomy {

/// Whether the warnings show signs of welded limbs.
bool shows_welds(const Anatomy& found);
/// The same for a result; an analysis that failed may have failed because of welds.
bool is_welded(const engine::Result<Anatomy>& found);
/// Whether one arm is much longer along the skin, as an arm is that has grown into the trunk.
bool arms_differ(const engine::Result<Anatomy>& found);
/// Whether limbs touch, so that paths along the skin are too short. A handle alone is no proof, because a
/// wall with a gap gives one as well.
bool limbs_meet(const Anatomy& found);
/// The number of limbs that touch, by paths that are too short.
int short_paths(const Anatomy& found);
/// The number of doubts: about landmarks, limbs that differ, an unusual body, and handles.
int doubts(const Anatomy& anatomy);
/// The number of doubts that are not about handles. Fingers that touch at their tips give a handle, but no
/// wrong path.
int doubts_but_handles(const Anatomy& anatomy);

}  // namespace bodice::anatomy
