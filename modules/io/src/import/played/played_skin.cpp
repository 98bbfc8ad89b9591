#include "import/played/played_skin.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "import/source/gltf_skin.hpp"

namespace bodice::inline v0_1::io {

namespace {

using engine::SortedJson;
using geometry::Vec3;

/// The skin's weights, all sets of a vertex one after the other.
rig::SkinWeights weights_of(const GltfDocument& document, const SortedJson& attributes,
                            std::size_t vertices) {
  std::vector<std::vector<std::pair<std::uint16_t, float>>> of_vertex(vertices);
  const auto add = [&](std::uint32_t vertex, double joint, double weight) {
    if (vertex < vertices && weight > 0.0)
      of_vertex[vertex].emplace_back(static_cast<std::uint16_t>(joint), static_cast<float>(weight));
  };
  std::size_t set = 0;
  while (set < kMostWeightSets && visit_weights(document, attributes, set, add)) ++set;
  rig::SkinWeights out;
  out.first.push_back(0);
  for (const auto& listed : of_vertex) {
    for (const auto& [joint, weight] : listed) out.joint.push_back(joint), out.weight.push_back(weight);
    out.first.push_back(static_cast<std::uint32_t>(out.joint.size()));
  }
  return out;
}

rig::Clip clip_of(const GltfDocument& document, const std::vector<std::ptrdiff_t>& joint_of_node) {
  rig::Clip clip;
  const SortedJson& animation = document.element("animations", 0);
  std::vector<rig::Track> tracks(joint_of_node.size());
  std::vector<bool> moved(joint_of_node.size(), false);
  for (const SortedJson& channel : array_at(animation, "channels")) {
    const SortedJson& target = channel.contains("target") ? channel["target"] : channel;
    const auto node = index_at(target, "node"), at = index_at(channel, "sampler");
    const SortedJson& samplers = array_at(animation, "samplers");
    if (!node || !at || *at >= samplers.size() || *node >= joint_of_node.size() || joint_of_node[*node] < 0)
      continue;
    const auto joint = static_cast<std::size_t>(joint_of_node[*node]);
    rig::Track& track = tracks[joint];
    track.joint = static_cast<std::uint16_t>(joint), moved[joint] = true;
    const std::string path = text_at(target, "path");
    if (path == "translation") read_keys(document, samplers[*at], track.translation);
    if (path == "rotation") read_keys(document, samplers[*at], track.rotation);
    if (path == "scale") read_keys(document, samplers[*at], track.scale);
  }
  const auto extend = [&](const auto& keys) {
    if (!keys.empty()) clip.duration_s = std::max(clip.duration_s, keys.time_s.back());
  };
  for (std::size_t j = 0; j < tracks.size(); ++j) {
    if (!moved[j]) continue;
    extend(tracks[j].translation), extend(tracks[j].rotation), extend(tracks[j].scale);
    clip.tracks.push_back(std::move(tracks[j]));
  }
  return clip;
}

/// The joint of each node, -1 where it is none; empty where a joint is no node.
std::vector<std::ptrdiff_t> joints_by_node(const SortedJson& joints, std::size_t nodes) {
  std::vector<std::ptrdiff_t> joint_of_node(nodes, -1);
  for (std::size_t j = 0; j < joints.size(); ++j) {
    if (!joints[j].is_number_unsigned() || joints[j].get<std::size_t>() >= nodes) return {};
    joint_of_node[joints[j].get<std::size_t>()] = static_cast<std::ptrdiff_t>(j);
  }
  return joint_of_node;
}

/// The joints in the order of the skin. Precondition: joints_by_node() of them, and a matrix each.
rig::Skeleton skeleton_of(const GltfDocument& document, const NodeTree& tree, const SortedJson& joints,
                          const std::vector<std::ptrdiff_t>& joint_of_node, const GltfNumbers& inverse) {
  rig::Skeleton skeleton;
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const auto node = joints[j].get<std::size_t>();
    rig::Joint joint;
    joint.name = text_at(document.element("nodes", node), "name");
    joint.local = tree.local(node);
    if (const std::ptrdiff_t up = tree.parent(node); up >= 0)
      joint.parent = static_cast<std::int32_t>(joint_of_node[static_cast<std::size_t>(up)]);
    const Eigen::Matrix4d bind = Eigen::Map<const Eigen::Matrix4d>(inverse.values.data() + 16 * j).inverse();
    joint.bind = bind.topRows<3>();
    skeleton.joints.push_back(std::move(joint));
  }
  return skeleton;
}

}  // namespace

std::optional<rig::Rig> played_rig(const GltfDocument& document, const NodeTree& tree,
                                   const SortedJson& body_node, std::size_t vertices) {
  const auto skin_at = index_at(body_node, "skin"), mesh_at = index_at(body_node, "mesh");
  if (!skin_at || !mesh_at) return std::nullopt;
  const SortedJson& skin = document.element("skins", *skin_at);
  const SortedJson& joints = array_at(skin, "joints");
  const auto inverse_at = index_at(skin, "inverseBindMatrices");
  const auto inverse = inverse_at ? document.numbers(*inverse_at) : std::nullopt;
  if (!inverse || inverse->components != 16 || inverse->count < joints.size()) return std::nullopt;
  const std::vector<std::ptrdiff_t> joint_of_node = joints_by_node(joints, tree.size());
  const SortedJson& primitives = array_at(document.element("meshes", *mesh_at), "primitives");
  if (joint_of_node.empty() || primitives.empty() || !primitives[0].contains("attributes"))
    return std::nullopt;
  rig::Rig rig;
  rig.skeleton = skeleton_of(document, tree, joints, joint_of_node, *inverse);
  rig.weights = weights_of(document, primitives[0]["attributes"], vertices);
  rig.clips.push_back(clip_of(document, joint_of_node));
  if (!rig::put_parents_first(rig) || !rig::mend(rig, vertices)) return std::nullopt;
  return rig;
}

std::vector<std::vector<Vec3>> played_frames(const engine::Context& context, const rig::Rig& rig,
                                             std::span<const Vec3> rest, std::span<const double> time_s) {
  std::vector<rig::Affine> world(rig.skeleton.joints.size()), skinning(world.size());
  std::vector<std::vector<Vec3>> frames;
  for (const double time : time_s) {
    rig::joint_matrices(rig.skeleton, rig.clips.front(), time, world);
    rig::skinning_matrices(rig.skeleton, world, skinning);
    frames.emplace_back(rest.size());
    rig::skin_linear(context, rest, rig.weights, skinning, frames.back());
  }
  return frames;
}

}  // namespace bodice::io
