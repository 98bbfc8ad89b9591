#include "distance/bvh.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include <bodice/engine/parallel.hpp>

#include "distance/bvh_builder.hpp"

namespace bodice::inline v0_1::geometry {
namespace {

constexpr std::size_t kLeafGrain = 512;

/// Whether a triangle has three vertices of the mesh, and all are finite.
bool has_corners(const TriMesh& mesh, std::size_t t) {
  return std::ranges::all_of(mesh.triangles[t], [&](Index v) { return v < mesh.positions.size(); }) &&
         mesh.corner(t, 0).allFinite() && mesh.corner(t, 1).allFinite() && mesh.corner(t, 2).allFinite();
}

void set_frame(Bvh& bvh, const TriMesh& mesh) {
  Box box;
  for (Index t : bvh.triangle_of_leaf)
    for (int k = 0; k < 3; ++k) box.extend(mesh.corner(t, k));
  bvh.origin = 0.5 * box.low + 0.5 * box.high;
  const double half = (0.5 * box.high - 0.5 * box.low).maxCoeff();
  bvh.scale = half > 0.0 ? std::exp2(std::ceil(std::log2(half))) : 1.0;
}

BvhTriangle local_triangle(const Bvh& bvh, const TriMesh& mesh, Index t) {
  const Vec3 a = bvh.to_local(mesh.corner(t, 0));
  return {a, bvh.to_local(mesh.corner(t, 1)) - a, bvh.to_local(mesh.corner(t, 2)) - a};
}

/// Sets the leaves from the triangles. A lane of a sliver keeps what it has, so that leaves are emptied
/// first.
void set_leaves(const engine::Context& context, Bvh& bvh) {
  engine::parallel_for(context, bvh.leaves.size(), kLeafGrain, [&](std::size_t begin, std::size_t end) {
    for (LeafTriangles& leaf : std::span(bvh.leaves).subspan(begin, end - begin)) {
      leaf = {.first = leaf.first, .count = leaf.count};
      for (std::uint32_t k = 0; k < leaf.count; ++k)
        leaf.set(static_cast<int>(k), bvh.triangles[leaf.first + k]);
    }
  });
}

/// The triangles of the mesh that a tree takes.
std::vector<Index> usable_triangles(const TriMesh& mesh) {
  std::vector<Index> usable;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    if (has_corners(mesh, t)) usable.push_back(static_cast<Index>(t));
  return usable;
}

FloatBox box_of_leaf(const Bvh& bvh, const LeafTriangles& leaf) {
  FloatBox box;
  for (std::uint32_t k = 0; k < leaf.count; ++k) box.extend(float_box(bvh.triangles[leaf.first + k]));
  return box;
}

/// Fits the boxes of all nodes to the triangles, children before parents.
void refit_nodes(Bvh& bvh) {
  std::vector<FloatBox> of_node(bvh.nodes.size());
  for (std::size_t n = bvh.nodes.size(); n-- > 0;) {
    BvhNode& node = bvh.nodes[n];
    for (int slot = 0; slot < BvhNode::kWidth; ++slot) {
      const std::uint32_t child = node.child[slot];
      if (child == BvhChild::kNone) continue;
      const FloatBox box = BvhChild::is_leaf(child) ? box_of_leaf(bvh, bvh.leaf(child)) : of_node[child];
      for (int k = 0; k < 3; ++k) node.low[k][slot] = box.low[k], node.high[k][slot] = box.high[k];
      of_node[n].extend(box);
    }
  }
}

}  // namespace

Bvh build_bvh(const engine::Context& context, const TriMesh& mesh) {
  Bvh bvh;
  bvh.triangle_of_leaf = usable_triangles(mesh);
  if (bvh.triangle_of_leaf.empty()) return bvh;
  set_frame(bvh, mesh);
  const std::size_t count = bvh.triangle_of_leaf.size();
  std::vector<BvhTriangle> unordered(count);
  for (std::size_t i = 0; i < count; ++i) unordered[i] = local_triangle(bvh, mesh, bvh.triangle_of_leaf[i]);
  BvhNodes divided = divide_triangles(context, unordered);
  bvh.nodes = std::move(divided.nodes), bvh.leaves = std::move(divided.leaves);
  const std::vector<Index> source = bvh.triangle_of_leaf;
  bvh.triangles.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    bvh.triangles[i] = unordered[divided.order[i]];
    bvh.triangle_of_leaf[i] = source[divided.order[i]];
  }
  set_leaves(context, bvh);
  return bvh;
}

Bvh refit_bvh(const engine::Context& context, const Bvh& like, const TriMesh& mesh) {
  const auto is_usable = [&](Index t) { return t < mesh.triangles.size() && has_corners(mesh, t); };
  if (like.triangle_of_leaf.size() != usable_triangles(mesh).size() ||
      !std::ranges::all_of(like.triangle_of_leaf, is_usable))
    return build_bvh(context, mesh);
  Bvh bvh = like;
  if (bvh.triangles.empty()) return bvh;
  set_frame(bvh, mesh);
  engine::parallel_for(context, bvh.triangles.size(), kLeafGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      bvh.triangles[i] = local_triangle(bvh, mesh, bvh.triangle_of_leaf[i]);
  });
  set_leaves(context, bvh);
  refit_nodes(bvh);
  return bvh;
}

}  // namespace bodice::geometry
