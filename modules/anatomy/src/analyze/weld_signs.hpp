// What warnings show of welded limbs, and how much they leave in doubt.
#pragma once

#include <bodice/anatomy/anatomy.hpp>

namespace bodice::inline v0_1::anatomy {

bool shows_welds(const Anatomy& found);
bool is_welded(const engine::Result<Anatomy>& found);
/// Whether paths along the skin are cut short. A handle alone, of a wall with a gap, may not do that.
bool limbs_meet(const Anatomy& found);
/// The number of doubts: about landmarks, limbs that differ, an unusual body, and handles.
int doubts(const Anatomy& anatomy);
/// Those that are not about handles: fingers that touch at their tips have one, and no path is wrong for it.
int doubts_but_handles(const Anatomy& anatomy);

}  // namespace bodice::anatomy
