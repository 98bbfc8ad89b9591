// Limbs that are welded to each other where they touch.
#pragma once

#include <optional>

#include <bodice/engine/result.hpp>

#include "landmarks/find_landmarks.hpp"

namespace bodice::inline v0_1::anatomy {

/// Whether a weld cuts a path along the skin short: from hand to foot, or from foot to foot.
bool hand_fused_to_leg(const BodyCoordinates& coordinates, int side);
bool legs_fused(const BodyCoordinates& coordinates);

/// The error that names what is fused, if that leaves no usable answer: a weld where limbs merely touch
/// spoils few landmarks, one far from the trunk moves extremities, midline and most of the borders.
std::optional<engine::Error> fused_limbs_error(const Skin& skin, const BodyCoordinates& coordinates,
                                               const CheckedLandmarks& landmarks);

}  // namespace bodice::anatomy
