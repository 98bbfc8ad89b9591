// A rig as glTF has it: nodes for joints, a skin, animations.
#pragma once

#include <cstddef>
#include <string>

#include <bodice/rig/rig.hpp>

#include "glb_builder.hpp"

namespace bodice::inline v0_1::io {

/// The samplers and channels of one animation.
struct GlbAnimation {
  std::string name;
  Json samplers = Json::array(), channels = Json::array();

  /// Adds a channel of a node and its sampler.
  void add(std::size_t node, const char* path, std::size_t input, std::size_t output,
           const char* interpolation);
};

/// Adds the vertices' joints and weights, strongest first, four a set.
void add_skin_attributes(const rig::SkinWeights& weights, GlbBuilder& glb, Json& attributes);

/// Indices that a skeleton got in a document.
struct GlbSkeleton {
  std::size_t first_node = 0;  ///< of joint 0; the others follow
  std::size_t skin = 0;
};
/// Adds the joints' nodes under one root of the scene, and the skin with its inverse bind matrices.
GlbSkeleton add_skeleton(const rig::Skeleton& skeleton, GlbBuilder& glb);

/// Adds the channels of a clip. A glTF animation ends with its last key, so that a clip which goes on gets
/// one more at its end. Times before 0 count as 0, and equal ones are set apart by the least that floats can.
void add_clip(rig::Clip clip, const rig::Skeleton& joints, const GlbSkeleton& skeleton, GlbBuilder& glb,
              GlbAnimation& animation);

}  // namespace bodice::io
