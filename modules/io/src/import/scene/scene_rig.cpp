#include "import/scene/scene_rig.hpp"

#include <algorithm>
#include <cmath>

#include "import/scene/bind_pose.hpp"

namespace bodice::inline v0_1::io {

namespace {

/// Ticks a second where a file does not state them.
constexpr double kDefaultTicks = 25.0;

void collect(const aiNode& node, std::int32_t parent, int depth, SceneNodes& nodes, FileRig& rig) {
  if (depth > kMaxNodeDepth) return;
  const auto index = static_cast<std::uint32_t>(rig.nodes.size());
  FileNode& out = rig.nodes.emplace_back();
  out.name = node.mName.C_Str();
  out.parent = parent;
  out.depth = depth;
  out.local = to_eigen(node.mTransformation);
  out.to_world = parent < 0 ? out.local : rig.nodes[static_cast<std::size_t>(parent)].to_world * out.local;
  nodes.node.push_back(&node);
  nodes.index.emplace(&node, index);
  nodes.first_named.emplace(out.name, index);
  for (unsigned i = 0; i < node.mNumChildren; ++i)
    collect(*node.mChildren[i], static_cast<std::int32_t>(index), depth + 1, nodes, rig);
}

rig::Vec3 value_of(const aiVectorKey& key) {
  return {static_cast<double>(key.mValue.x), static_cast<double>(key.mValue.y),
          static_cast<double>(key.mValue.z)};
}
Eigen::Quaterniond value_of(const aiQuatKey& key) {
  return Eigen::Quaterniond(static_cast<double>(key.mValue.w), static_cast<double>(key.mValue.x),
                            static_cast<double>(key.mValue.y), static_cast<double>(key.mValue.z));
}

template <class T, class Key>
rig::Keys<T> keys_of(const Key* keys, unsigned count, double ticks_per_second) {
  rig::Keys<T> out;
  for (unsigned i = 0; i < count; ++i) {
    out.time_s.push_back(keys[i].mTime / ticks_per_second);
    out.value.push_back(value_of(keys[i]));
  }
  return out;
}

/// Some readers leave a last key or a duplicate out of order; keys at one time keep their order.
template <class T>
void sort_keys(rig::Keys<T>& keys) {
  if (std::is_sorted(keys.time_s.begin(), keys.time_s.end())) return;
  std::vector<std::size_t> order(keys.time_s.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return keys.time_s[a] < keys.time_s[b]; });
  rig::Keys<T> sorted;
  for (const std::size_t i : order) {
    sorted.time_s.push_back(keys.time_s[i]);
    sorted.value.push_back(keys.value[i]);
  }
  keys = std::move(sorted);
}

rig::Track track_of(const aiNodeAnim& channel, double ticks_per_second) {
  rig::Track track;
  track.translation = keys_of<rig::Vec3>(channel.mPositionKeys, channel.mNumPositionKeys, ticks_per_second);
  track.rotation =
      keys_of<rig::Quaternion>(channel.mRotationKeys, channel.mNumRotationKeys, ticks_per_second);
  track.scale = keys_of<rig::Vec3>(channel.mScalingKeys, channel.mNumScalingKeys, ticks_per_second);
  sort_keys(track.translation);
  sort_keys(track.rotation);
  sort_keys(track.scale);
  return track;
}

FileClip clip_of(const aiAnimation& animation, const SceneNodes& nodes) {
  FileClip clip;
  clip.name = animation.mName.C_Str();
  const double ticks = animation.mTicksPerSecond > 0.0 ? animation.mTicksPerSecond : kDefaultTicks;
  clip.duration_s = animation.mDuration / ticks;
  for (unsigned i = 0; i < animation.mNumChannels; ++i) {
    const aiNodeAnim& channel = *animation.mChannels[i];
    const auto node = nodes.first_named.find(channel.mNodeName.C_Str());
    if (node != nodes.first_named.end()) clip.tracks.emplace_back(node->second, track_of(channel, ticks));
  }
  return clip;
}

}  // namespace

SceneNodes collect_nodes(const aiScene& scene, FileRig& rig) {
  SceneNodes nodes;
  collect(*scene.mRootNode, -1, 1, nodes, rig);
  return nodes;
}

std::vector<FileBone> bones_of(const aiMesh& mesh, const SceneNodes& nodes) {
  std::vector<FileBone> bones;
  for (unsigned i = 0; i < mesh.mNumBones; ++i) {
    const aiBone& from = *mesh.mBones[i];
    const auto node = nodes.first_named.find(from.mName.C_Str());
    if (node == nodes.first_named.end()) continue;
    FileBone& bone = bones.emplace_back();
    bone.node = node->second;
    bone.offset = to_eigen(from.mOffsetMatrix);
    for (unsigned k = 0; k < from.mNumWeights; ++k)
      bone.weights.emplace_back(from.mWeights[k].mVertexId, from.mWeights[k].mWeight);
  }
  return bones;
}

std::vector<FileClip> clips_of(const aiScene& scene, const SceneNodes& nodes) {
  std::vector<FileClip> clips;
  for (unsigned i = 0; i < scene.mNumAnimations; ++i) clips.push_back(clip_of(*scene.mAnimations[i], nodes));
  return clips;
}

}  // namespace bodice::io
