// The leaves with particles that moved since crossings were last counted, and the groups of these. Few
// particles move in a round of corrections, and a pass over all groups would cost more than the corrections.
#pragma once

#include <compare>
#include <cstdint>
#include <span>
#include <vector>

#include "pairs/pairs.hpp"

namespace bodice::inline v0_1::cloth {

/// A group of a task, by its indices.
struct GroupOfTask {
  std::uint32_t task = 0, group = 0;

  auto operator<=>(const GroupOfTask&) const = default;
};

/// The leaves that moved, and an index of the groups of all leaves.
struct MovedLeaves {
  std::vector<std::uint8_t> is_moved;  ///< #leaves
  std::vector<std::uint32_t> leaves;   ///< those that are, each once
  bool indexed = false;                ///< whether the index belongs to the present groups
  std::vector<std::uint32_t> begin;    ///< #leaves + 1: offsets into `groups`
  std::vector<GroupOfTask> groups;     ///< those of each leaf
  std::vector<GroupOfTask> chosen;     ///< room for groups_of_moved()
};

/// No leaf has moved yet. Keeps room for a few groups a leaf, so that few frames need more.
MovedLeaves make_moved_leaves(const ContactMesh& mesh);

/// Notes that the triangles of these particles moved. O(triangles of the particles).
void note_moved(const ContactMesh& mesh, std::span<const Index> particles, MovedLeaves& moved);

/// Forgets which leaves moved. O(moved leaves).
void forget_moved(MovedLeaves& moved);

/// The groups of all leaves that moved, each once, by task and then in the order of the task. The index is
/// made where the groups were listed anew: O(groups). Otherwise O(n log n) in the groups that are returned.
std::span<const GroupOfTask> groups_of_moved(const std::vector<PairTask>& tasks, MovedLeaves& moved);

}  // namespace bodice::cloth
