#pragma once

#include <bodice/body/part.hpp>

#include "skin/skin.hpp"

namespace bodice::inline v0_1::anatomy {

/// Keeps the largest patch of each part; every smaller one takes the part that surrounds most of it, one of
/// the trunk the other half of its level where that touches it. O(#E).
void absorb_small_components(const Skin& skin, std::vector<body::Part>& part);

}  // namespace bodice::anatomy
