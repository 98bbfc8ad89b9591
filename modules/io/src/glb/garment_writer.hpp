// Garments in a GLB: a mesh with a morph target for each kept frame, and the weights that play them.
#pragma once

#include <vector>

#include <bodice/io/scene.hpp>

#include "file_space.hpp"
#include "skin_writer.hpp"

namespace bodice::inline v0_1::io {

/// The times of a track's frames in the file: from 0, or with a rig those of its clip.
std::vector<float> times_of(const GarmentTrack& track, bool has_rig);

/// Adds garment `k` of the scene, and its channel to the animation.
void add_garment(const Scene& scene, std::size_t k, FileSpace& space, GlbBuilder& glb,
                 GlbAnimation& animation);

}  // namespace bodice::io
