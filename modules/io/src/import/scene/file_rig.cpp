#include "import/scene/file_rig.hpp"

#include <Eigen/LU>

#include <bodice/rig/affine.hpp>

namespace bodice::inline v0_1::io {

namespace {

/// Bind matrices of one node that differ by less, relative to their size, are the same but for rounding:
/// floats keep 6e-8, and a product of several loses a digit or two.
constexpr double kSameBind = 1e-5;

bool same_bind(const Eigen::Matrix4d& a, const Eigen::Matrix4d& b) {
  return (a - b).norm() <= kSameBind * a.norm();
}

std::uint32_t add_binding(std::uint32_t node, const Eigen::Matrix4d& bind, FileRig& rig) {
  std::vector<std::uint32_t>& of_node = rig.nodes[node].bindings;
  for (const std::uint32_t b : of_node)
    if (same_bind(rig.bindings[b].bind, bind)) return b;
  of_node.push_back(static_cast<std::uint32_t>(rig.bindings.size()));
  rig.bindings.push_back({node, bind});
  return of_node.back();
}

engine::Error no_inverse_bind(const FileNode& node) {
  return {engine::ErrorCode::kUnusableGeometry,
          "Bone '" + node.name + "' has no usable inverse bind matrix: it is singular or not finite.",
          "Bind the skin again and export it with its bind pose."};
}

/// Calls visit(vertex, binding, weight) for each weight that counts.
template <class Visit>
void for_each_weight(std::span<const FileBone> bones, std::span<const std::uint32_t> binding,
                     std::size_t vertices, Visit&& visit) {
  for (std::size_t b = 0; b < bones.size(); ++b)
    for (const auto& [vertex, weight] : bones[b].weights)
      if (vertex < vertices && weight != 0.0f) visit(vertex, binding[b], weight);
}

FileWeights table_of(std::span<const FileBone> bones, std::span<const std::uint32_t> binding,
                     std::size_t vertices) {
  FileWeights table;
  table.first.assign(vertices + 1, 0);
  for_each_weight(bones, binding, vertices,
                  [&](std::size_t v, std::uint32_t, float) { ++table.first[v + 1]; });
  for (std::size_t v = 0; v < vertices; ++v) table.first[v + 1] += table.first[v];
  table.binding.resize(table.first.back());
  table.weight.resize(table.first.back());
  std::vector<std::uint32_t> next(table.first.begin(), table.first.end() - 1);
  for_each_weight(bones, binding, vertices, [&](std::size_t v, std::uint32_t b, float weight) {
    table.binding[next[v]] = b;
    table.weight[next[v]++] = weight;
  });
  return table;
}

FileWeights all_to(std::uint32_t binding, std::size_t vertices) {
  FileWeights table;
  for (std::size_t v = 0; v <= vertices; ++v) table.first.push_back(static_cast<std::uint32_t>(v));
  table.binding.assign(vertices, binding);
  table.weight.assign(vertices, 1.0f);
  return table;
}

}  // namespace

FileWeights bind_mesh(std::span<const FileBone> bones, std::uint32_t node,
                      const Eigen::Matrix4d& mesh_to_world, std::size_t vertices, FileRig& rig) {
  if (bones.empty()) return all_to(add_binding(node, mesh_to_world, rig), vertices);
  std::vector<std::uint32_t> binding;
  for (const FileBone& bone : bones) {
    if (!rig::is_invertible(bone.offset.topRows<3>()) || !mesh_to_world.allFinite()) {
      if (!rig.flaw) rig.flaw = no_inverse_bind(rig.nodes[bone.node]);
      return {};
    }
    binding.push_back(add_binding(bone.node, mesh_to_world * bone.offset.inverse(), rig));
    rig.nodes[bone.node].is_bone = true;
  }
  return table_of(bones, binding, vertices);
}

FileWeights take_weights(const FileWeights& weights, std::span<const geometry::Index> vertices) {
  FileWeights taken;
  if (weights.first.empty()) return taken;
  taken.first.reserve(vertices.size() + 1);
  taken.first.push_back(0);
  for (const geometry::Index v : vertices) {
    for (std::uint32_t e = weights.first[v]; e < weights.first[v + 1]; ++e) {
      taken.binding.push_back(weights.binding[e]);
      taken.weight.push_back(weights.weight[e]);
    }
    taken.first.push_back(static_cast<std::uint32_t>(taken.binding.size()));
  }
  return taken;
}

void append(const FileWeights& weights, FileWeights& to) {
  if (weights.first.empty()) return;
  if (to.first.empty()) to.first.push_back(0);
  const std::uint32_t base = to.first.back();
  for (std::size_t v = 1; v < weights.first.size(); ++v) to.first.push_back(base + weights.first[v]);
  to.binding.insert(to.binding.end(), weights.binding.begin(), weights.binding.end());
  to.weight.insert(to.weight.end(), weights.weight.begin(), weights.weight.end());
}

}  // namespace bodice::io
