#pragma once

#include <cstddef>

namespace bodice::inline v0_1::rig {

/// Vertices a block: a vertex with two joints takes 8 ns blended linearly and 20 ns as a dual quaternion.
inline constexpr std::size_t kSkinGrain = 4096;

}  // namespace bodice::rig
