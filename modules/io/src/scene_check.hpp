#pragma once

#include <bodice/engine/result.hpp>
#include <bodice/io/scene.hpp>

namespace bodice::inline v0_1::io {

/// Fails for a scene that no writer can draw: an empty one, counts that do not match, numbers that are not
/// finite.
engine::Result<void> check_scene(const Scene& scene);

/// Whether the track has frames at different times, so that there is something to play.
bool takes_time(const GarmentTrack& track);

/// The box around everything in the scene, meters, y up.
geometry::Box scene_box(const Scene& scene);

/// The color of the k-th garment, sRGB 0..1.
std::array<float, 3> garment_color(std::size_t k);

}  // namespace bodice::io
