#pragma once

#include <cstddef>

namespace bodice::rig {

/// Vertices a block: a vertex with four joints takes about 25 ns, so that a block is worth its task.
inline constexpr std::size_t kSkinGrain = 1024;

}  // namespace bodice::rig
