// Based on: Khronos Group. glTF 2.0 Specification. 2021. - sections 3.7.3 (skins), 3.11 (animations)
#include "import/scene/gltf_rig.hpp"

#include <algorithm>
#include <string>

#include "import/source/gltf_skin.hpp"

namespace bodice::inline v0_1::io {

using engine::SortedJson;

std::optional<GltfRig> GltfRig::match(GltfDocument document, const SceneNodes& nodes) {
  GltfRig rig;
  rig.document_ = std::move(document);
  rig.document_node_.assign(nodes.node.size(), kNone);
  rig.scene_node_.assign(array_at(rig.document_.root(), "nodes").size(), kNoNode);
  const SortedJson& scene =
      rig.document_.element("scenes", index_at(rig.document_.root(), "scene").value_or(0));
  const SortedJson& roots = array_at(scene, "nodes");
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
  const SortedJson& children = array_at(document_.element("nodes", document_node), "children");
  if (children.size() != node.mNumChildren) return false;
  for (std::size_t i = 0; i < children.size(); ++i)
    if (!children[i].is_number_unsigned() || !walk(children[i].get<std::size_t>(), *node.mChildren[i], nodes))
      return false;
  return true;
}

std::vector<FileBone> GltfRig::bones_of_skin(const SortedJson& skin) const {
  const SortedJson& joints = array_at(skin, "joints");
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

const SortedJson& GltfRig::node(std::uint32_t scene_node) const {
  return document_.element("nodes", document_node_[scene_node]);  // kNone is beyond all nodes
}

const SortedJson& GltfRig::primitive(std::uint32_t scene_node, std::size_t primitive) const {
  static const SortedJson kNothing;
  const auto mesh = index_at(node(scene_node), "mesh");
  const SortedJson& primitives = array_at(mesh ? document_.element("meshes", *mesh) : kNothing, "primitives");
  return primitive < primitives.size() ? primitives[primitive] : kNothing;
}

std::vector<FileBone> GltfRig::bones(std::uint32_t scene_node, std::size_t primitive) const {
  if (document_node_[scene_node] == kNone) return {};
  const SortedJson& node = document_.element("nodes", document_node_[scene_node]);
  const auto skin = index_at(node, "skin"), mesh = index_at(node, "mesh");
  if (!skin || !mesh) return {};
  const SortedJson& primitives = array_at(document_.element("meshes", *mesh), "primitives");
  if (primitive >= primitives.size() || !primitives[primitive].is_object()) return {};
  const SortedJson* attributes = primitives[primitive].find("attributes");
  std::vector<FileBone> bones = bones_of_skin(document_.element("skins", *skin));
  if (!attributes || bones.empty()) return bones;
  const auto add = [&](std::uint32_t vertex, double joint, double weight) {
    if (weight != 0.0 && joint >= 0.0 && joint < static_cast<double>(bones.size()))
      bones[static_cast<std::size_t>(joint)].weights.emplace_back(vertex, static_cast<float>(weight));
  };
  std::size_t set = 0;
  while (set < kMostWeightSets && visit_weights(document_, *attributes, set, add)) ++set;
  return bones;
}

void GltfRig::add_track(const SortedJson& channel, const SortedJson& animation, FileClip& clip) const {
  if (!channel.is_object() || !channel.contains("target")) return;
  const auto node = index_at(channel["target"], "node"), at = index_at(channel, "sampler");
  const std::string path = text_at(channel["target"], "path");
  if (!node || *node >= scene_node_.size() || scene_node_[*node] == kNoNode) return;
  if (path != "translation" && path != "rotation" && path != "scale") return;  // weights of morph targets
  const SortedJson& samplers = array_at(animation, "samplers");
  const SortedJson sampler = at && *at < samplers.size() ? samplers[*at] : SortedJson();
  auto track = std::find_if(clip.tracks.begin(), clip.tracks.end(),
                            [&](const auto& other) { return other.first == scene_node_[*node]; });
  if (track == clip.tracks.end()) track = clip.tracks.insert(track, {scene_node_[*node], {}});
  rig::Track& keys = track->second;
  const auto read = [&](auto& of_path) {
    if (!read_keys(document_, sampler, of_path))
      clip.flaw = "a channel's keys are missing or do not match their times";
    else if (!of_path.empty())
      clip.duration_s = std::max(clip.duration_s, of_path.time_s.back());
  };
  if (path == "translation") read(keys.translation);
  if (path == "rotation") read(keys.rotation);
  if (path == "scale") read(keys.scale);
}

std::vector<FileClip> GltfRig::clips() const {
  std::vector<FileClip> clips;
  for (const SortedJson& animation : array_at(document_.root(), "animations")) {
    FileClip& clip = clips.emplace_back();
    clip.name = text_at(animation, "name");
    for (const SortedJson& channel : array_at(animation, "channels")) add_track(channel, animation, clip);
  }
  return clips;
}

}  // namespace bodice::io
