// Parts of a glTF document that move a skin: sets of weights, and the keys of animations.
#pragma once

#include <cstdint>

#include <bodice/engine/function_ref.hpp>
#include <bodice/rig/clip.hpp>

#include "import/source/gltf_document.hpp"

namespace bodice::inline v0_1::io {

/// Sets of four weights a vertex that are read of one primitive.
inline constexpr std::size_t kMostWeightSets = 64;

/// Calls visit(vertex, joint, weight) for all weights of set number `set`, JOINTS_n and WEIGHTS_n, in the
/// order of the vertices, those of zero included. False where there is no such set.
bool visit_weights(const GltfDocument& document, const engine::SortedJson& attributes, std::size_t set,
                   engine::FunctionRef<void(std::uint32_t, double, double)> visit);

/// Reads the keys of a sampler. False where its times and values are missing or do not fit together; the keys
/// then stay as they are.
bool read_keys(const GltfDocument& document, const engine::SortedJson& sampler, rig::Keys<rig::Vec3>& keys);
bool read_keys(const GltfDocument& document, const engine::SortedJson& sampler,
               rig::Keys<rig::Quaternion>& keys);

}  // namespace bodice::io
