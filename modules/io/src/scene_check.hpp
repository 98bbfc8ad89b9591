#pragma once

#include <bodice/engine/result.hpp>
#include <bodice/io/scene.hpp>

namespace bodice::io {

/// What no writer could draw: nothing at all, counts that do not match, numbers that are not finite.
engine::Result<void> check_scene(const Scene& scene);

/// Whether there is anything to play: not where all frames have the same time.
bool takes_time(const GarmentTrack& track);

/// Of everything in the scene, meters, y up.
geometry::Box scene_box(const Scene& scene);

/// Cloth's color, sRGB 0..1, for the k-th garment.
std::array<float, 3> garment_color(std::size_t k);

}  // namespace bodice::io
