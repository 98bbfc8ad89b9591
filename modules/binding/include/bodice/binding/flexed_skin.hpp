// The skin with its limbs half bent: where the ellipsoids of a body that will move are fitted best.
//
// A straight leg is nearly one cone, so that a fitted ellipsoid may span its knee. Ellipsoids that are fitted
// to half-bent limbs (fitting::FitOptions::flexed) end at the joints, and stay right whether a limb bends or
// stretches.
#pragma once

#include <span>
#include <vector>

#include <bodice/binding/bind.hpp>
#include <bodice/body/part.hpp>

namespace bodice::inline v0_1::binding {

/// #V: the skin with hips, knees, elbows and shoulders half bent from where the bind pose has them: arms to
/// the front, since raised ones would go on with the clavicles in one line. `part`
/// (#V) gives the skin that a joint must carry; names of joints do not matter. Joints that are bent already
/// stay, and so do limbs of which no joint is found. Empty if none is bent. O(#V #J).
std::vector<Vec3> flexed_skin(const engine::Context& context, const SkinnedBody& body,
                              std::span<const body::Part> part);

}  // namespace bodice::binding
