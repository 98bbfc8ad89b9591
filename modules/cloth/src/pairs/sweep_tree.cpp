#include "pairs/sweep_tree.hpp"

#include <bit>

#include <bodice/engine/parallel.hpp>

namespace bodice::inline v0_1::cloth {
namespace {

constexpr float kBeyondAll_m = 1e30f;
constexpr std::size_t kFitsATask = 128;

// A sweep of nothing.
Sweep no_sweep() {
  const Float4 far = {kBeyondAll_m, kBeyondAll_m, kBeyondAll_m, 0.0f};
  return {far, -far, far, -far};
}

// A leaf of the tree without particles, which does not move.
Sweep empty_leaf() {
  Sweep sweep = no_sweep();
  sweep.move_low = sweep.move_high = splat(0.0f);
  return sweep;
}

}  // namespace

SweepTree make_sweep_tree(const ContactMesh& mesh) {
  SweepTree tree;
  tree.leaves = mesh.leaves();
  tree.width = std::bit_ceil(tree.leaves);
  tree.node.assign(2 * tree.width, empty_leaf());
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
    for (std::size_t leaf = begin; leaf < end; ++leaf)
      tree.node[tree.width + leaf] = sweep_of(mesh, leaf, points);
  });
  for (std::size_t k = tree.width; k-- > 1;) {
    tree.node[k] = tree.node[2 * k];
    const Sweep& right = tree.node[2 * k + 1];
    if (right.low[0] <= right.high[0]) add(right, tree.node[k]);  // else there is nothing in it
  }
}

void refit_leaf(const ContactMesh& mesh, std::size_t leaf, const SweptPoints& points, SweepTree& tree) {
  const Sweep all = tree.node[tree.width + leaf] = sweep_of(mesh, leaf, points);
  for (std::size_t k = (tree.width + leaf) / 2; k > 0; k /= 2) add(all, tree.node[k]);
}

}  // namespace bodice::cloth
