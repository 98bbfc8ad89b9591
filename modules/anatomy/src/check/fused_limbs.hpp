// Limbs that are welded to each other where they touch.
#pragma once

#include <optional>

#include <bodice/engine/result.hpp>

#include "check/cross_check.hpp"

namespace bodice::anatomy {

/// A way along the skin that a weld cuts short: from hand to foot, from foot to foot.
bool hand_fused_to_leg(const BodyCoordinates& coordinates, int side);
bool legs_fused(const BodyCoordinates& coordinates);

/// The sentence that names what is fused, if that leaves no usable answer: a weld where limbs merely touch
/// spoils few places, one far from the trunk moves ends, middle and most of the borders.
std::optional<engine::Error> fused_limbs_error(const Skin& skin, const BodyCoordinates& coordinates,
                                               const Landmarks& marks, const CrossCheck& second);

}  // namespace bodice::anatomy
