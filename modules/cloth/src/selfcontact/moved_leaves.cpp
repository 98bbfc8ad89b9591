#include "selfcontact/moved_leaves.hpp"

#include <algorithm>
#include <utility>

namespace bodice::inline v0_1::cloth {
namespace {

constexpr std::size_t kTasksOfLeaf = 4;
constexpr std::uint32_t kNoTask = ~std::uint32_t{0};

// Calls visit(leaf, task) once for each task that has groups of the leaf.
template <class Visit>
void for_each_task_of_leaf(const std::vector<PairTask>& tasks, std::vector<std::uint32_t>& last_task,
                           Visit&& visit) {
  std::ranges::fill(last_task, kNoTask);
  for (std::uint32_t t = 0; t < tasks.size(); ++t) {
    const auto visit_leaves = [&](const auto& groups) {
      for (const auto& group : groups)
        for (const std::uint32_t leaf : group.leaf)
          if (std::exchange(last_task[leaf], t) != t) visit(leaf, t);
    };
    visit_leaves(tasks[t].groups), visit_leaves(tasks[t].clear);
  }
}

void index_tasks(const std::vector<PairTask>& tasks, MovedLeaves& m) {
  std::ranges::fill(m.begin, 0u);
  for_each_task_of_leaf(tasks, m.last_task, [&](std::uint32_t leaf, std::uint32_t) { ++m.begin[leaf + 1]; });
  for (std::size_t leaf = 1; leaf < m.begin.size(); ++leaf) m.begin[leaf] += m.begin[leaf - 1];
  m.tasks.resize(m.begin.back());
  // Each offset moves on to the end of its leaf while the leaf is filled, which is the next leaf's offset.
  for_each_task_of_leaf(tasks, m.last_task,
                        [&](std::uint32_t leaf, std::uint32_t task) { m.tasks[m.begin[leaf]++] = task; });
  std::shift_right(m.begin.begin(), m.begin.end(), 1);
  m.begin.front() = 0;
  m.indexed = true;
}

}  // namespace

MovedLeaves make_moved_leaves(const ContactMesh& mesh, std::size_t tasks) {
  MovedLeaves moved;
  moved.is_moved.resize(mesh.leaves()), moved.last_task.resize(mesh.leaves());
  moved.leaves.reserve(mesh.leaves());
  moved.begin.resize(mesh.leaves() + 1);
  moved.tasks.reserve(kTasksOfLeaf * mesh.leaves());
  moved.is_chosen.resize(tasks);
  moved.chosen.reserve(tasks);
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

std::span<const std::uint32_t> tasks_of_moved(const std::vector<PairTask>& tasks, MovedLeaves& m) {
  if (!m.indexed) index_tasks(tasks, m);
  m.chosen.clear();
  for (const std::uint32_t leaf : m.leaves)
    for (std::uint32_t k = m.begin[leaf]; k < m.begin[leaf + 1]; ++k)
      if (std::exchange(m.is_chosen[m.tasks[k]], std::uint8_t{1}) == 0) m.chosen.push_back(m.tasks[k]);
  for (const std::uint32_t task : m.chosen) m.is_chosen[task] = 0;
  return m.chosen;
}

}  // namespace bodice::cloth
