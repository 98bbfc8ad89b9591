// Positions of a garment over time as point caches, which Blender, Maya, 3ds Max and LightWave read.
#pragma once

#include <filesystem>

#include <bodice/engine/result.hpp>
#include <bodice/io/scene.hpp>

namespace bodice::inline v0_1::io {

/// Writes the kept frames of a garment as PC2 (little-endian) or MDD (big-endian, with times), by the file's
/// extension, in the unit and axes of `frame`, as floats. Vertices are those of the garment's mesh in the
/// GLB, in its order. Fails with kInvalidArgument where the extension is neither .pc2 nor .mdd, or where
/// there is no frame, and with kWriteFailed. The file appears whole or not at all.
engine::Result<void> write_cloth_cache(const GarmentTrack& track, const geometry::Frame& frame,
                                       const std::filesystem::path& file);

}  // namespace bodice::io
