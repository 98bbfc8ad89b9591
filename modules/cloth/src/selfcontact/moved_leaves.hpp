// The leaves with particles that moved since crossings were last counted, and the tasks with groups of such
// leaves. Few particles move in a round of corrections, so that a pass over all tasks would cost more than
// the round.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "pairs/pairs.hpp"

namespace bodice::inline v0_1::cloth {

/// The leaves that moved, and an index of the tasks of all leaves.
struct MovedLeaves {
  std::vector<std::uint8_t> is_moved;    ///< #leaves
  std::vector<std::uint32_t> leaves;     ///< the indices of the moved leaves, each once
  bool indexed = false;                  ///< whether the index belongs to the present groups
  std::vector<std::uint32_t> begin;      ///< #leaves + 1: offsets into `tasks`
  std::vector<std::uint32_t> tasks;      ///< for each leaf, the tasks with groups of it
  std::vector<std::uint32_t> last_task;  ///< #leaves: room to index
  std::vector<std::uint8_t> is_chosen;   ///< #tasks: room for tasks_of_moved(), all zero between calls
  std::vector<std::uint32_t> chosen;     ///< the result of tasks_of_moved()

  bool has_moved(const PairGroup& group) const {
    return (is_moved[group.leaf[0]] | is_moved[group.leaf[1]]) != 0;
  }
};

/// No leaf has moved yet. Keeps room for a few tasks a leaf, so that few frames need more.
MovedLeaves make_moved_leaves(const ContactMesh& mesh, std::size_t tasks);

/// Notes that the triangles of these particles moved. O(triangles of the particles).
void note_moved(const ContactMesh& mesh, std::span<const Index> particles, MovedLeaves& moved);

/// Forgets which leaves moved. O(moved leaves).
void forget_moved(MovedLeaves& moved);

/// The tasks with groups of moved leaves, each once, in no particular order. Cost: O(moved leaves), and
/// O(groups) where groups were listed anew, for the index.
std::span<const std::uint32_t> tasks_of_moved(const std::vector<PairTask>& tasks, MovedLeaves& moved);

}  // namespace bodice::cloth
