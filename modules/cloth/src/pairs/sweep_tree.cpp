#include "pairs/sweep_tree.hpp"

#include <bit>

#include <bodice/engine/parallel.hpp>

namespace bodice::inline v0_1::cloth {
namespace {

constexpr float kBeyondAll_m = 1e30f;
constexpr std::size_t kFitsATask = 128;

// A leaf of the tree without particles, which does not move.
Sweep empty_leaf() {
  Sweep sweep = no_sweep();
  sweep.move_low = sweep.move_high = splat(0.0f);
  return sweep;
}

void fit_leaf(const ContactMesh& mesh, std::size_t leaf, std::span<const Point> at,
              std::span<const Point> move, SweepTree& tree) {
  Sweep all = no_sweep();
  for (const Index i : mesh.particles_of(leaf)) {
    const Float4 p = xyz(load(at[i])), m = move.empty() ? splat(0.0f) : xyz(load(move[i]));
    add({p, p, m, m}, all);
  }
  tree.node[tree.width + leaf] = all;
}

}  // namespace

SweepTree make_sweep_tree(const ContactMesh& mesh) {
  SweepTree tree;
  tree.leaves = mesh.leaves();
  tree.width = std::bit_ceil(tree.leaves);
  tree.node.assign(2 * tree.width, empty_leaf());
  return tree;
}

void refit(const engine::Context& context, const ContactMesh& mesh, std::span<const Point> at,
           std::span<const Point> move, SweepTree& tree) {
  engine::parallel_for(context, mesh.leaves(), kFitsATask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t leaf = begin; leaf < end; ++leaf) fit_leaf(mesh, leaf, at, move, tree);
  });
  for (std::size_t k = tree.width; k-- > 1;) {
    tree.node[k] = tree.node[2 * k];
    const Sweep& right = tree.node[2 * k + 1];
    if (right.low[0] <= right.high[0]) add(right, tree.node[k]);  // else there is nothing in it
  }
}

void refit_leaf(const ContactMesh& mesh, std::size_t leaf, std::span<const Point> at,
                std::span<const Point> move, SweepTree& tree) {
  Sweep all = no_sweep();
  for (const Index i : mesh.particles_of(leaf)) {
    const Float4 p = xyz(load(at[i])), around = xyz(splat(at[i].weight)), m = xyz(load(move[i]));
    add({p - around, p + around, m, m}, all);
  }
  tree.node[tree.width + leaf] = all;
  for (std::size_t k = (tree.width + leaf) / 2; k > 0; k /= 2) add(all, tree.node[k]);
}

Sweep no_sweep() {
  const Float4 far = {kBeyondAll_m, kBeyondAll_m, kBeyondAll_m, 0.0f};
  return {far, -far, far, -far};
}

}  // namespace bodice::cloth
