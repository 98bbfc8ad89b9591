// Frames of a garment as morph targets: displacements of its vertices and normals.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "glb_builder.hpp"

namespace bodice::inline v0_1::io {

/// One frame of a garment in the mesh's unit and axes.
struct FrameShape {
  std::vector<Vec3f> positions, normals;  ///< #V each; normals have length 1
};

/// Targets in floats beyond this many bytes are quantized.
inline constexpr std::size_t kMostFloatTargetBytes = std::size_t{8} << 20;

/// Adds `count` frames as displacements from `base`, as a primitive lists them.
Json add_float_targets(const FrameShape& base, std::size_t count,
                       const std::function<FrameShape(std::size_t)>& frame, GlbBuilder& glb);

/// The least power of two that no coordinate of a displacement exceeds. O(#V count).
float displacement_scale(std::span<const Vec3f> base, std::size_t count,
                         const std::function<std::vector<Vec3f>(std::size_t)>& frame);

/// The same as 16-bit positions in units of `scale`, by which the mesh's node must be scaled, and 8-bit
/// normals, those of every third frame and of the last: frames between take the normals of the frame before.
/// Vertices that do not move are left out. A position is off by scale / 65534 at most.
/// `base` and `frame` give positions divided by `scale`.
Json add_quantized_targets(const FrameShape& base, std::size_t count,
                           const std::function<FrameShape(std::size_t)>& frame, GlbBuilder& glb);

}  // namespace bodice::io
