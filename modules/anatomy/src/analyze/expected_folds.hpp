// Corrections of folds with positions that do not fit the limbs and the trunk.
#pragma once

#include <vector>

#include "walls/webs.hpp"

namespace bodice::inline v0_1::anatomy {

/// The folds of a body with limbs that were cut apart, with corrections. A fold far from the position that
/// limbs and trunk predict moves there. An armpit that is too low by the room inside the body as well moves
/// between both. Empty if no fold moves. Cost: that of find_folds().
std::vector<Fold> expected_folds(const engine::Context& context, const geometry::TriMesh& skin,
                                 const Anatomy& found);

/// Warns of folds that were far from their predicted positions `before` limbs were cut again, and are near
/// them `after` that. The cause of the first error may affect the second result as well. Armpits of which the
/// room inside the body confirms both are not in doubt.
void doubt_moved_folds(const engine::Context& context, const geometry::TriMesh& skin, const Anatomy& before,
                       Anatomy& after);

/// The webs that the levels of folds reveal. On a skin with closed holes, or where both armpits are hidden,
/// levels alone are evidence. At armpits of any other skin, the room inside the body must agree.
std::vector<Web> webs_by_level(const engine::Context& context, const geometry::TriMesh& skin,
                               const Options& options, const Anatomy& found);

}  // namespace bodice::anatomy
