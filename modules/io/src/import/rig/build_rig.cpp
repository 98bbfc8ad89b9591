#include "import/rig/build_rig.hpp"

#include <iterator>

#include <bodice/engine/message.hpp>
#include <bodice/geometry/mesh_edges.hpp>

#include "import/rig/build_skeleton.hpp"

namespace bodice::inline v0_1::io {

namespace {

using geometry::Index;
using geometry::kNoIndex;

/// For each vertex of the skin the first input vertex that became it.
std::vector<Index> first_inputs(std::span<const Index> vertex_of_input, std::size_t vertices) {
  std::vector<Index> input(vertices, 0);
  std::vector<bool> found(vertices);
  for (std::size_t i = 0; i < vertex_of_input.size(); ++i) {
    const Index v = vertex_of_input[i];
    if (v == kNoIndex || found[v]) continue;
    found[v] = true;
    input[v] = static_cast<Index>(i);
  }
  return input;
}

/// For each vertex itself, or the vertex that gives it weights: a nearest one along edges that has any.
std::vector<Index> donors(const FileWeights& weights, const geometry::TriMesh& skin, std::size_t& without) {
  const std::size_t count = skin.positions.size();
  std::vector<Index> donor(count, kNoIndex), queue;
  for (Index v = 0; v < count; ++v)
    if (weights.first[v] < weights.first[v + 1]) {
      donor[v] = v;
      queue.push_back(v);
    }
  without = count - queue.size();
  if (without > 0) {
    const geometry::MeshEdges edges = geometry::mesh_edges(skin);
    const geometry::EdgesOfVertex at = geometry::edges_of_vertex(count, edges);
    for (std::size_t head = 0; head < queue.size(); ++head) {
      const Index from = queue[head];
      for (std::size_t e = at.offset[from]; e < at.offset[from + 1]; ++e)
        for (const Index to : edges.ends[at.edge[e]])
          if (donor[to] == kNoIndex) {
            donor[to] = donor[from];
            queue.push_back(to);
          }
    }
  }
  for (Index v = 0; v < count; ++v)
    if (donor[v] == kNoIndex) donor[v] = v;
  return donor;
}

std::vector<bool> used_bindings(const FileRig& file, const FileWeights& weights) {
  std::vector<bool> used(file.bindings.size());
  for (const std::uint32_t b : weights.binding) used[b] = true;
  return used;
}

engine::Error no_skeleton() {
  return {engine::ErrorCode::kNotFound, "The body is not bound to a skeleton.",
          "Export it with its armature and skin weights, or let bodice make a rig for it."};
}

}  // namespace

engine::Result<rig::Rig> build_rig(const FileRig& file, const FileWeights& weights,
                                   const geometry::TriMesh& skin, std::span<const Index> vertex_of_input,
                                   const geometry::Frame& frame, std::vector<engine::Warning>& warnings) {
  if (!file.has_bones && !file.flaw) return no_skeleton();
  if (file.flaw) return *file.flaw;
  FileWeights on_skin = take_weights(weights, first_inputs(vertex_of_input, skin.positions.size()));
  if (on_skin.first.empty()) return no_skeleton();
  std::size_t without = 0;
  on_skin = take_weights(on_skin, donors(on_skin, skin, without));
  if (without > 0)
    warnings.push_back(
        {"weights-missing", "",
         engine::message(without, " of ", skin.positions.size(),
                         " vertices have no skin weights; they follow the nearest vertex that has."),
         "Bind every vertex before exporting."});

  auto built = build_skeleton(file, used_bindings(file, on_skin), frame);
  if (!built) return built.error();
  rig::Rig rig;
  rig.skeleton = std::move(built->skeleton);
  rig.clips = std::move(built->clips);
  rig.weights.first = std::move(on_skin.first);
  rig.weights.weight = std::move(on_skin.weight);
  for (const std::uint32_t b : on_skin.binding) rig.weights.joint.push_back(built->joint_of_binding[b]);
  auto mended = mend(rig, skin.positions.size());
  if (!mended) return mended.error();
  std::move(built->warnings.begin(), built->warnings.end(), std::back_inserter(warnings));
  std::move(mended->begin(), mended->end(), std::back_inserter(warnings));
  return rig;
}

}  // namespace bodice::io
