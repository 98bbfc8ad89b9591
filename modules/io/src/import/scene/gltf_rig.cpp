// Based on: Khronos Group. glTF 2.0 Specification. 2021. - sections 3.7.3 (skins), 3.11 (animations)
#include "import/scene/gltf_rig.hpp"

#include <algorithm>
#include <map>
#include <string>

namespace bodice::io {

namespace {

using nlohmann::json;

constexpr std::size_t kMostSets = 64;  // of four weights a vertex

/// Adds the weights of one set, JOINTS_n and WEIGHTS_n; false if there is no such set.
bool add_set(const GltfDocument& document, const json& attributes, std::size_t set,
             std::vector<FileBone>& bones) {
  const auto joints_at = index_at(attributes, ("JOINTS_" + std::to_string(set)).c_str());
  const auto weights_at = index_at(attributes, ("WEIGHTS_" + std::to_string(set)).c_str());
  if (!joints_at || !weights_at) return false;
  const auto joints = document.numbers(*joints_at), weights = document.numbers(*weights_at);
  if (!joints || !weights || joints->components != 4 || weights->components != 4 ||
      joints->count != weights->count)
    return false;
  for (std::size_t i = 0; i < weights->values.size(); ++i) {
    const double joint = joints->values[i];
    if (weights->values[i] != 0.0 && joint >= 0.0 && joint < static_cast<double>(bones.size()))
      bones[static_cast<std::size_t>(joint)].weights.emplace_back(static_cast<std::uint32_t>(i / 4),
                                                                  static_cast<float>(weights->values[i]));
  }
  return true;
}

rig::Interpolation interpolation_of(const json& sampler) {
  const std::string name = text_at(sampler, "interpolation");
  if (name == "STEP") return rig::Interpolation::kStep;
  return name == "CUBICSPLINE" ? rig::Interpolation::kCubic : rig::Interpolation::kLinear;
}

rig::Vec3 make(const double* at, rig::Vec3) {
  return {at[0], at[1], at[2]};
}
Eigen::Quaterniond make(const double* at, const Eigen::Quaterniond&) {
  return {at[3], at[0], at[1], at[2]};
}

/// The keys of a sampler; false if its times and values do not fit together.
template <class T>
bool read_keys(const GltfNumbers& time, const GltfNumbers& value, rig::Interpolation interpolation,
               std::size_t components, rig::Keys<T>& keys) {
  const std::size_t per_key = interpolation == rig::Interpolation::kCubic ? 3 : 1;
  if (time.components != 1 || value.components != components || value.count != per_key * time.count)
    return false;
  keys.interpolation = interpolation;
  keys.time_s = time.values;
  keys.value.clear();
  for (std::size_t i = 0; i < value.count; ++i)
    keys.value.push_back(make(value.values.data() + i * components, T()));
  return true;
}

}  // namespace

std::optional<GltfRig> GltfRig::match(GltfDocument document, const SceneNodes& nodes) {
  GltfRig rig;
  rig.document_ = std::move(document);
  rig.document_node_.assign(nodes.node.size(), kNone);
  rig.scene_node_.assign(array_at(rig.document_.root(), "nodes").size(), kNoNode);
  const json& scene = rig.document_.element("scenes", index_at(rig.document_.root(), "scene").value_or(0));
  const json& roots = array_at(scene, "nodes");
  const aiNode& root = *nodes.node.front();
  if (roots.size() != 1 && roots.size() != root.mNumChildren) return std::nullopt;
  for (std::size_t i = 0; i < roots.size(); ++i) {
    const aiNode& node = roots.size() == 1 ? root : *root.mChildren[i];
    if (!roots[i].is_number_unsigned() || !rig.walk(roots[i].get<std::size_t>(), node, nodes))
      return std::nullopt;
  }
  return rig;
}

bool GltfRig::walk(std::size_t document_node, const aiNode& node, const SceneNodes& nodes) {
  const auto index = nodes.index.find(&node);
  if (index == nodes.index.end()) return true;  // deeper than is read
  if (document_node >= scene_node_.size()) return false;
  document_node_[index->second] = document_node;
  scene_node_[document_node] = index->second;
  const json& children = array_at(document_.element("nodes", document_node), "children");
  if (children.size() != node.mNumChildren) return false;
  for (std::size_t i = 0; i < children.size(); ++i)
    if (!children[i].is_number_unsigned() || !walk(children[i].get<std::size_t>(), *node.mChildren[i], nodes))
      return false;
  return true;
}

std::vector<FileBone> GltfRig::bones_of_skin(const json& skin) const {
  const json& joints = array_at(skin, "joints");
  const auto inverse_at = index_at(skin, "inverseBindMatrices");
  const auto inverse = inverse_at ? document_.numbers(*inverse_at) : std::nullopt;
  std::vector<FileBone> bones(joints.size());
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const std::size_t node = joints[j].is_number_unsigned() ? joints[j].get<std::size_t>() : kNone;
    if (node >= scene_node_.size() || scene_node_[node] == kNoNode) return {};
    bones[j].node = scene_node_[node];
    if (inverse && inverse->components == 16 && j < inverse->count)
      bones[j].offset = Eigen::Map<const Eigen::Matrix4d>(inverse->values.data() + 16 * j);
    else if (inverse_at)
      bones[j].offset.setZero();  // stated, but not there
  }
  return bones;
}

std::vector<FileBone> GltfRig::bones(std::uint32_t scene_node, std::size_t primitive) const {
  if (document_node_[scene_node] == kNone) return {};
  const json& node = document_.element("nodes", document_node_[scene_node]);
  const auto skin = index_at(node, "skin"), mesh = index_at(node, "mesh");
  if (!skin || !mesh) return {};
  const json& primitives = array_at(document_.element("meshes", *mesh), "primitives");
  if (primitive >= primitives.size() || !primitives[primitive].is_object()) return {};
  const auto attributes = primitives[primitive].find("attributes");
  std::vector<FileBone> bones = bones_of_skin(document_.element("skins", *skin));
  if (attributes == primitives[primitive].end() || bones.empty()) return bones;
  std::size_t set = 0;
  while (set < kMostSets && add_set(document_, *attributes, set, bones)) ++set;
  return bones;
}

void GltfRig::add_track(const json& channel, const json& animation, FileClip& clip) const {
  if (!channel.is_object() || !channel.contains("target")) return;
  const auto node = index_at(channel["target"], "node"), at = index_at(channel, "sampler");
  const std::string path = text_at(channel["target"], "path");
  if (!node || *node >= scene_node_.size() || scene_node_[*node] == kNoNode) return;
  if (path != "translation" && path != "rotation" && path != "scale") return;  // weights of morph targets
  const json& samplers = array_at(animation, "samplers");
  const json sampler = at && *at < samplers.size() ? samplers[*at] : json();
  const auto time_at = index_at(sampler, "input"), value_at = index_at(sampler, "output");
  const auto time = time_at ? document_.numbers(*time_at) : std::nullopt;
  const auto value = value_at ? document_.numbers(*value_at) : std::nullopt;
  auto track = std::find_if(clip.tracks.begin(), clip.tracks.end(),
                            [&](const auto& other) { return other.first == scene_node_[*node]; });
  if (track == clip.tracks.end()) track = clip.tracks.insert(track, {scene_node_[*node], {}});
  const rig::Interpolation how = interpolation_of(sampler);
  rig::Track& keys = track->second;
  const bool read = time && value &&
                    (path == "rotation"
                         ? read_keys(*time, *value, how, 4, keys.rotation)
                         : read_keys(*time, *value, how, 3, path == "scale" ? keys.scale : keys.translation));
  if (!read) clip.flaw = "a channel's keys are missing or do not match their times";
  if (read && !time->values.empty()) clip.duration_s = std::max(clip.duration_s, time->values.back());
}

std::vector<FileClip> GltfRig::clips() const {
  std::vector<FileClip> clips;
  for (const json& animation : array_at(document_.root(), "animations")) {
    FileClip& clip = clips.emplace_back();
    clip.name = text_at(animation, "name");
    for (const json& channel : array_at(animation, "channels")) add_track(channel, animation, clip);
  }
  return clips;
}

}  // namespace bodice::io
