// Based on: Khronos Group. glTF 2.0 Specification. 2021. - sections 3.7.3 (skins), 3.11 (animations)
#include "skin_writer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace bodice::inline v0_1::io {

namespace {

using rig::Interpolation;
using rig::Vec3;

const char* name_of(Interpolation interpolation) {
  if (interpolation == Interpolation::kStep) return "STEP";
  return interpolation == Interpolation::kCubic ? "CUBICSPLINE" : "LINEAR";
}

/// The entries of a vertex by falling weight; equal ones keep their order.
void sort_entries(const rig::SkinWeights& weights, std::size_t vertex, std::vector<std::uint32_t>& entries) {
  entries.clear();
  for (std::uint32_t e = weights.first[vertex]; e < weights.first[vertex + 1]; ++e) entries.push_back(e);
  std::stable_sort(entries.begin(), entries.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return weights.weight[a] > weights.weight[b]; });
}

Json node_of(const rig::Joint& joint) {
  Json node = {{"name", joint.name}};
  const rig::LocalTransform& local = joint.local;
  const Eigen::Quaterniond q = local.rotation.normalized();
  if (!local.translation.isZero(0.0))
    node["translation"] = {local.translation.x(), local.translation.y(), local.translation.z()};
  if (q.vec() != Vec3::Zero()) node["rotation"] = {q.x(), q.y(), q.z(), q.w()};
  if (local.scale != Vec3::Ones()) node["scale"] = {local.scale.x(), local.scale.y(), local.scale.z()};
  return node;
}

std::size_t add_inverse_binds(const rig::Skeleton& skeleton, GlbBuilder& glb) {
  std::vector<float> values;
  values.reserve(16 * skeleton.joints.size());
  for (const rig::Joint& joint : skeleton.joints) {
    Eigen::Matrix4f matrix = Eigen::Matrix4f::Identity();
    matrix.topRows<3>() = rig::inverse(joint.bind).cast<float>();
    values.insert(values.end(), matrix.data(), matrix.data() + 16);
  }
  return glb.add_values(values, "MAT4");
}

std::vector<float> rising_times(const std::vector<double>& time_s) {
  std::vector<float> times;
  times.reserve(time_s.size());
  for (const double t : time_s) {
    float time = static_cast<float>(std::max(t, 0.0));
    if (!times.empty())
      time = std::max(time, std::nextafter(times.back(), std::numeric_limits<float>::max()));
    times.push_back(time);
  }
  return times;
}

void append_key(const Vec3& value, bool, std::vector<float>& out) {
  for (int k = 0; k < 3; ++k) out.push_back(static_cast<float>(value[k]));
}
void append_key(const Eigen::Quaterniond& value, bool is_tangent, std::vector<float>& out) {
  const Eigen::Vector4d q = is_tangent ? value.coeffs() : value.normalized().coeffs();
  for (int k = 0; k < 4; ++k) out.push_back(static_cast<float>(q[k]));
}

template <class T>
void add_keys(const rig::Keys<T>& keys, std::size_t node, const char* path, GlbBuilder& glb,
              GlbAnimation& animation) {
  if (keys.empty()) return;
  std::vector<float> values;
  const bool cubic = keys.interpolation == Interpolation::kCubic;
  for (std::size_t i = 0; i < keys.value.size(); ++i) append_key(keys.value[i], cubic && i % 3 != 1, values);
  const std::size_t input = glb.add_times(rising_times(keys.time_s));
  const std::size_t output = glb.add_values(values, std::is_same_v<T, Vec3> ? "VEC3" : "VEC4");
  animation.add(node, path, input, output, name_of(keys.interpolation));
}

/// Calls use(keys) with each kind of keys of a track that is there.
template <class Use>
void each_keys(rig::Track& track, Use use) {
  if (!track.translation.empty()) use(track.translation);
  if (!track.rotation.empty()) use(track.rotation);
  if (!track.scale.empty()) use(track.scale);
}

/// Holds the last value until a time.
template <class T>
void hold(double time_s, rig::Keys<T>& keys) {
  const std::size_t count = keys.value.size();
  keys.time_s.push_back(time_s);
  if (keys.interpolation != Interpolation::kCubic) {
    keys.value.push_back(T(keys.value[count - 1]));
    return;
  }
  T flat = keys.value[count - 1];
  if constexpr (std::is_same_v<T, Vec3>)
    flat.setZero();
  else
    flat.coeffs().setZero();
  keys.value[count - 1] = flat;
  for (const T& value : {flat, T(keys.value[count - 2]), flat}) keys.value.push_back(value);
}

/// Gives a clip that goes on after its last key one more at its end, which changes no pose.
void hold_until_end(const rig::Skeleton& joints, rig::Clip& clip) {
  double last_s = 0.0;
  const rig::Track* latest = nullptr;
  for (rig::Track& track : clip.tracks)
    each_keys(track, [&](const auto& keys) {
      if (latest && keys.time_s.back() <= last_s) return;
      latest = &track;
      last_s = keys.time_s.back();
    });
  if (!(clip.duration_s > last_s) || joints.joints.empty()) return;
  if (!latest) {
    rig::Track still;
    still.translation = {Interpolation::kLinear, {0.0}, {joints.joints[0].local.translation}};
    clip.tracks.assign(1, still);
    latest = &clip.tracks.front();
  }
  bool done = false;
  each_keys(clip.tracks[static_cast<std::size_t>(latest - clip.tracks.data())], [&](auto& keys) {
    if (!done) hold(clip.duration_s, keys);
    done = true;
  });
}

}  // namespace

void GlbAnimation::add(std::size_t node, const char* path, std::size_t input, std::size_t output,
                       const char* interpolation) {
  channels.push_back({{"sampler", samplers.size()}, {"target", {{"node", node}, {"path", path}}}});
  samplers.push_back({{"input", input}, {"output", output}, {"interpolation", interpolation}});
}

void add_skin_attributes(const rig::SkinWeights& weights, GlbBuilder& glb, Json& attributes) {
  std::size_t most = 1;
  for (std::size_t v = 0; v < weights.vertices(); ++v)
    most = std::max<std::size_t>(most, weights.first[v + 1] - weights.first[v]);
  std::vector<std::uint32_t> entries;
  for (std::size_t set = 0; 4 * set < most; ++set) {
    std::vector<std::uint16_t> joints(4 * weights.vertices(), 0);
    std::vector<float> values(4 * weights.vertices(), 0.0f);
    for (std::size_t v = 0; v < weights.vertices(); ++v) {
      sort_entries(weights, v, entries);
      for (std::size_t k = 4 * set; k < std::min(entries.size(), 4 * set + 4); ++k) {
        joints[4 * v + k - 4 * set] = weights.joint[entries[k]];
        values[4 * v + k - 4 * set] = weights.weight[entries[k]];
      }
    }
    attributes["JOINTS_" + std::to_string(set)] = glb.add_joints(joints);
    attributes["WEIGHTS_" + std::to_string(set)] = glb.add_weights(values);
  }
}

GlbSkeleton add_skeleton(const rig::Skeleton& skeleton, GlbBuilder& glb) {
  const std::size_t count = skeleton.joints.size();
  std::vector<Json> children(count, Json::array());
  Json roots = Json::array(), joints = Json::array();
  GlbSkeleton out;
  out.first_node = glb.size("nodes");
  for (std::size_t j = 0; j < count; ++j) {
    const std::int32_t parent = skeleton.joints[j].parent;
    (parent < 0 ? roots : children[static_cast<std::size_t>(parent)]).push_back(out.first_node + j);
    joints.push_back(out.first_node + j);
  }
  for (std::size_t j = 0; j < count; ++j) {
    Json node = node_of(skeleton.joints[j]);
    if (!children[j].empty()) node["children"] = children[j];
    glb.add("nodes", std::move(node));
  }
  // A skin's joints need a common root, which several roots have only in a node above them.
  const std::size_t root = roots.size() == 1 ? roots[0].get<std::size_t>()
                                             : glb.add("nodes", {{"name", "skeleton"}, {"children", roots}});
  glb.add_to_scene(root);
  out.skin = glb.add("skins", {{"name", "skin"},
                               {"inverseBindMatrices", add_inverse_binds(skeleton, glb)},
                               {"skeleton", root},
                               {"joints", joints}});
  return out;
}

void add_clip(rig::Clip clip, const rig::Skeleton& joints, const GlbSkeleton& skeleton, GlbBuilder& glb,
              GlbAnimation& animation) {
  hold_until_end(joints, clip);
  for (const rig::Track& track : clip.tracks) {
    const std::size_t node = skeleton.first_node + track.joint;
    add_keys(track.translation, node, "translation", glb, animation);
    add_keys(track.rotation, node, "rotation", glb, animation);
    add_keys(track.scale, node, "scale", glb, animation);
  }
}

}  // namespace bodice::io
