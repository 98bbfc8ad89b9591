#include "selfcontact/moved_leaves.hpp"

#include <algorithm>

namespace bodice::inline v0_1::cloth {
namespace {

constexpr std::size_t kGroupsOfLeaf = 8;

// Calls visit(leaf, group) for each group once a leaf; a group of one leaf is visited once.
template <class Visit>
void for_each_leaf_of_group(const std::vector<PairTask>& tasks, Visit&& visit) {
  for (std::uint32_t t = 0; t < tasks.size(); ++t)
    for (std::uint32_t g = 0; g < tasks[t].groups.size(); ++g) {
      const PairGroup& group = tasks[t].groups[g];
      visit(group.leaf[0], GroupOfTask{t, g});
      if (group.leaf[1] != group.leaf[0]) visit(group.leaf[1], GroupOfTask{t, g});
    }
}

void index_groups(const std::vector<PairTask>& tasks, MovedLeaves& m) {
  std::ranges::fill(m.begin, 0u);
  for_each_leaf_of_group(tasks, [&](std::uint32_t leaf, GroupOfTask) { ++m.begin[leaf + 1]; });
  for (std::size_t leaf = 1; leaf < m.begin.size(); ++leaf) m.begin[leaf] += m.begin[leaf - 1];
  m.groups.resize(m.begin.back());
  // Each offset moves on to the end of its leaf while the leaf is filled, which is the next leaf's offset.
  for_each_leaf_of_group(tasks,
                         [&](std::uint32_t leaf, GroupOfTask group) { m.groups[m.begin[leaf]++] = group; });
  std::shift_right(m.begin.begin(), m.begin.end(), 1);
  m.begin.front() = 0;
  m.indexed = true;
}

}  // namespace

MovedLeaves make_moved_leaves(const ContactMesh& mesh) {
  MovedLeaves moved;
  moved.is_moved.resize(mesh.leaves());
  moved.leaves.reserve(mesh.leaves());
  moved.begin.resize(mesh.leaves() + 1);
  moved.groups.reserve(kGroupsOfLeaf * mesh.leaves());
  moved.chosen.reserve(kGroupsOfLeaf * mesh.leaves());
  return moved;
}

void note_moved(const ContactMesh& mesh, std::span<const Index> particles, MovedLeaves& moved) {
  for (const Index i : particles)
    for (const std::uint32_t face : mesh.star_of(i)) {
      const std::uint32_t leaf = mesh.leaf_of[face];
      if (moved.is_moved[leaf]) continue;
      moved.is_moved[leaf] = 1;
      moved.leaves.push_back(leaf);
    }
}

void forget_moved(MovedLeaves& moved) {
  for (const std::uint32_t leaf : moved.leaves) moved.is_moved[leaf] = 0;
  moved.leaves.clear();
}

std::span<const GroupOfTask> groups_of_moved(const std::vector<PairTask>& tasks, MovedLeaves& m) {
  if (!m.indexed) index_groups(tasks, m);
  m.chosen.clear();
  for (const std::uint32_t leaf : m.leaves)
    for (std::uint32_t k = m.begin[leaf]; k < m.begin[leaf + 1]; ++k) {
      const GroupOfTask group = m.groups[k];
      const std::uint32_t first = tasks[group.task].groups[group.group].leaf[0];
      if (first == leaf || !m.is_moved[first]) m.chosen.push_back(group);  // that of two moved leaves once
    }
  std::ranges::sort(m.chosen);
  return m.chosen;
}

}  // namespace bodice::cloth
