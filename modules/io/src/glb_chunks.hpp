// The words with which a GLB file and its chunks begin.
// Based on: Khronos Group. glTF 2.0 Specification. 2021. - section 4.4 (GLB)
#pragma once

#include <cstdint>

namespace bodice::inline v0_1::io {

inline constexpr std::uint32_t kGlbMagic = 0x46546C67, kGlbVersion = 2;
inline constexpr std::uint32_t kGlbJsonChunk = 0x4E4F534A, kGlbBinaryChunk = 0x004E4942;

}  // namespace bodice::io
