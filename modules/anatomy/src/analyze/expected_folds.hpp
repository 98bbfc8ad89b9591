// Folds that lie where limbs and trunk contradict them.
#pragma once

#include <vector>

#include "walls/webs.hpp"

namespace bodice::inline v0_1::anatomy {

/// The folds of a body with limbs that were parted. Those that are far from where limbs and trunk let expect
/// them lie there instead; armpits that the room inside the body has too low as well lie between both. Empty
/// if none is. Cost: as find_folds.
std::vector<Fold> expected_folds(const engine::Context& context, const geometry::TriMesh& skin,
                                 const Anatomy& found);

/// Warns of folds that lie where they are expected `after` limbs were parted anew, and were far off `before`:
/// what misled the first look may mislead the second.
void doubt_moved_folds(const Anatomy& before, Anatomy& after);

/// The webs that show by the levels of folds: alone, on a skin that was closed or hides both armpits; at
/// armpits of any skin together with the room inside the body.
std::vector<Web> webs_by_level(const engine::Context& context, const geometry::TriMesh& skin,
                               const Options& options, const Anatomy& found);

}  // namespace bodice::anatomy
