#include "pairs/sweep_tree.hpp"

#include <algorithm>

#include <bodice/engine/parallel.hpp>

namespace bodice::inline v0_1::cloth {
namespace {

constexpr float kBeyondAll_m = 1e30f;
constexpr std::size_t kFitsATask = 128;

// A sweep of nothing, which is near nothing.
Sweep no_sweep() {
  const Float4 far = {kBeyondAll_m, kBeyondAll_m, kBeyondAll_m, 0.0f};
  return {far, -far, far, -far};
}

void set_lane(SweepQuad& quad, std::size_t lane, const Sweep& sweep) {
  for (int axis = 0; axis < 3; ++axis) {
    quad.low[axis][lane] = sweep.low[axis], quad.high[axis][lane] = sweep.high[axis];
    quad.move_low[axis][lane] = sweep.move_low[axis], quad.move_high[axis][lane] = sweep.move_high[axis];
  }
}

// The sweep that bounds all lanes.
Sweep bounds_of(const SweepQuad& quad) {
  const auto least = [](Float4 v) { return std::min({v[0], v[1], v[2], v[3]}); };
  const auto most = [](Float4 v) { return std::max({v[0], v[1], v[2], v[3]}); };
  Sweep all = no_sweep();
  for (int axis = 0; axis < 3; ++axis) {
    all.low[axis] = least(quad.low[axis]), all.high[axis] = most(quad.high[axis]);
    all.move_low[axis] = least(quad.move_low[axis]), all.move_high[axis] = most(quad.move_high[axis]);
  }
  return all;
}

void set_leaf(std::size_t leaf, SweepTree& tree) {
  set_lane(tree.quad[tree.first_leaf_quad + leaf / 4], leaf % 4, tree.leaf[leaf]);
}

// Fits the lane that bounds a quad other than the root; returns the quad that has it.
std::size_t set_parent(std::size_t quad, SweepTree& tree) {
  const std::size_t parent = (quad - 1) / 4;
  set_lane(tree.quad[parent], (quad - 1) % 4, bounds_of(tree.quad[quad]));
  return parent;
}

}  // namespace

SweepTree make_sweep_tree(const ContactMesh& mesh) {
  SweepTree tree;
  while (4 * tree.leaves_a_lane < mesh.leaves()) {
    tree.first_leaf_quad = 4 * tree.first_leaf_quad + 1;
    tree.leaves_a_lane *= 4;
  }
  tree.leaf.assign(mesh.leaves(), no_sweep());
  SweepQuad empty;
  for (std::size_t lane = 0; lane < 4; ++lane) set_lane(empty, lane, no_sweep());
  tree.quad.assign(tree.first_leaf_quad + tree.leaves_a_lane, empty);
  return tree;
}

Sweep sweep_of(const ContactMesh& mesh, std::size_t leaf, const SweptPoints& points) {
  Sweep all = no_sweep();
  for (const Index i : mesh.particles_of(leaf)) {
    const Float4 p = xyz(load(points.at[i]));
    const Float4 move = points.move.empty() ? splat(0.0f) : xyz(load(points.move[i]));
    const Float4 room = points.room_m.empty() ? splat(0.0f) : xyz(splat(points.room_m[i]));
    add({p - room, p + room, move, move}, all);
  }
  return all;
}

void refit(const engine::Context& context, const ContactMesh& mesh, const SweptPoints& points,
           SweepTree& tree) {
  engine::parallel_for(context, mesh.leaves(), kFitsATask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t leaf = begin; leaf < end; ++leaf) {
      tree.leaf[leaf] = sweep_of(mesh, leaf, points);
      set_leaf(leaf, tree);
    }
  });
  for (std::size_t quad = tree.quad.size(); quad-- > 1;) set_parent(quad, tree);
}

void refit_leaf(const ContactMesh& mesh, std::size_t leaf, const SweptPoints& points, SweepTree& tree) {
  tree.leaf[leaf] = sweep_of(mesh, leaf, points);
  set_leaf(leaf, tree);
  for (std::size_t quad = tree.first_leaf_quad + leaf / 4; quad > 0;) quad = set_parent(quad, tree);
}

}  // namespace bodice::cloth
