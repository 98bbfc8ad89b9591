// The skinned body of a glTF document at times of its first animation.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <bodice/engine/context.hpp>
#include <bodice/rig/rig.hpp>

#include "import/played/node_tree.hpp"

namespace bodice::inline v0_1::io {

/// The rig that a skin and the first animation of a document make for a mesh of so many vertices; empty where
/// they do not fit together. Joints need no order; what stands above all of them does not move the skin.
std::optional<rig::Rig> played_rig(const GltfDocument& document, const NodeTree& tree,
                                   const engine::SortedJson& body_node, std::size_t vertices);

/// The skin at each time.
std::vector<std::vector<geometry::Vec3>> played_frames(const engine::Context& context, const rig::Rig& rig,
                                                       std::span<const geometry::Vec3> rest,
                                                       std::span<const double> time_s);

}  // namespace bodice::io
