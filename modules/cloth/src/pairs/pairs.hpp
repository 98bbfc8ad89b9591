// The pairs of parts of the cloth that may touch: a particle and a triangle, or two edges. A search lists
// groups: two leaves of triangles that may come near each other in the next frame. The pairs of a group are
// found anew once its leaves have moved against each other.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <bodice/engine/context.hpp>

#include "pairs/closest.hpp"
#include "pairs/sweep_tree.hpp"

namespace bodice::inline v0_1::cloth {

inline constexpr std::uint32_t kNoContact = ~std::uint32_t{0};
inline constexpr float kGapUnknown = -1.0f;

/// Two parts of the cloth without a common particle.
struct Pair {
  Index particle[4];           ///< those of A, then those of B (Corners)
  float apart_until_m = 0.0f;  ///< while its group's travel is less, it is farther apart than its gap
  /// The distance to keep; kGapUnknown: not computed yet, 0: the pair has no contact.
  float gap_m = kGapUnknown;
  /// Index of its contact in this substep, valid where its group is fresh.
  std::uint32_t contact = kNoContact;
  bool edges = false;
};

/// Two leaves and their pairs.
struct PairGroup {
  std::uint32_t leaf[2];
  std::uint32_t begin = 0, end = 0;  ///< its range in PairTask::pairs
  /// Bound on how far the two leaves moved against each other since the group was listed.
  float travel_m = 0.0f;
  float step_m = 0.0f;            ///< the same for this substep alone; set by find_crossing()
  float apart_until_m = 0.0f;     ///< while `travel_m` is less, none of its pairs is nearer than its gap
  float complete_until_m = 0.0f;  ///< while `travel_m` is less, its list of pairs is complete
  bool joined = false;            ///< are_joined()
  bool folded = false;            ///< whether its patch was not flat at the last test (travel_while_flat())
  bool spared = false;            ///< whether it has no pairs because its patch was flat
  bool inside = false;            ///< whether all of its particles are in one block
  bool fresh = false;             ///< whether its pairs' contacts belong to this substep
};

/// Two leaves that stay so far apart on their expected paths that they need no pairs.
struct ClearGroup {
  std::uint32_t leaf[2];
  float room_m;  ///< their least distance on the expected paths, less the gap, meters

  /// Whether their parts stay farther apart than the gap while leaves deviate from the expected paths by
  /// `deviation_m`, #leaves.
  bool holds(std::span<const float> deviation_m) const {
    return deviation_m[leaf[0]] + deviation_m[leaf[1]] < room_m;
  }
};

/// The two leaves of a group, by which groups are sorted.
inline std::pair<std::uint32_t, std::uint32_t> leaves_of(const PairGroup& group) {
  return {group.leaf[0], group.leaf[1]};
}
inline std::pair<std::uint32_t, std::uint32_t> leaves_of(const ClearGroup& group) {
  return {group.leaf[0], group.leaf[1]};
}

/// A pair that is near in this substep.
struct PairContact {
  Float4 weight;  ///< Closest::weight when the substep began
  Float4 normal;  ///< from B to A then, of length 1
  Index particle[4];
  float apart_m;  ///< distance then
  float gap_m;    ///< distance to keep
  bool edges;
};

/// A pair of triangles that cross.
struct Tangle {
  std::uint32_t a = 0, b = 0;  ///< a < b: indices into ContactMesh::faces

  auto operator<=>(const Tangle&) const = default;
};

/// The work of one task: the groups of consecutive leaves of one block, each with itself and with all later
/// leaves.
struct PairTask {
  std::size_t first_leaf = 0, last_leaf = 0;
  std::vector<PairGroup> groups, groups_before;  ///< sorted by leaves_of(); those of the last search
  std::vector<ClearGroup> clear;                 ///< in the same order
  std::vector<PairGroup> woken;                  ///< room for those that are no longer clear
  std::vector<std::uint32_t> near;               ///< room for a search
  std::vector<Pair> pairs;               ///< the pairs of all groups, and some that are no longer used
  std::vector<Pair> spare;               ///< room for the same, for drop_unused_pairs()
  std::size_t used = 0;                  ///< number of pairs in use
  std::vector<PairContact> contacts[2];  ///< [0]: groups across blocks, [1]: groups inside
  std::vector<Tangle> tangles;
  std::vector<std::uint32_t> crossing;  ///< pairs that would cross in this substep
  std::vector<Pair> pressed;            ///< pairs that would cross and may, because nothing can separate them
  std::vector<PairContact> held;        ///< contacts of the pairs in `crossing`, with a smaller gap
  std::vector<std::uint32_t> folded;  ///< leaves of folded groups when the substep ended, some several times
};

/// The tasks of a garment.
std::vector<PairTask> make_pair_tasks(const ContactMesh& mesh);

/// A new group of two leaves with a distance that exceeds the gap by `room_m`.
PairGroup new_group(const ContactMesh& mesh, std::size_t leaf, std::size_t other, float room_m);

/// Merges groups, which are in order, into those of a task.
void add_groups(std::span<const PairGroup> groups, PairTask& task);

/// Lists the groups of all leaves that come nearer than `reach_m` within the sweeps of the tree, which bound
/// the expected paths. Leaves that stay apart on these become clear groups. Other groups that were listed
/// before keep their pairs. A new group has no pairs, and needs none until it has moved by its distance less
/// the gap. The result is the same for any number of workers.
void find_groups(const engine::Context& context, const ContactMesh& mesh, const SweepTree& tree,
                 float reach_m, float gap_m, std::vector<PairTask>& tasks);

/// Turns clear groups into groups with pairs, where the deviations `deviation_m` (#leaves) from the expected
/// paths have used up their room.
void wake_groups(const ContactMesh& mesh, std::span<const float> deviation_m, PairTask& task);

/// The parameters of a search for pairs.
struct PairSearch {
  float gap_m = 0.0f;
  float slack_m = 0.0f;       ///< how far leaves may move against each other before pairs are found anew
  float step_m = 0.0f;        ///< how far the two leaves move against each other in this substep
  std::span<const Point> at;  ///< #P: positions
  /// #leaves: 1 for a leaf with a folded group. Triangles between the leaf's own may have turned over, so
  /// that none of its groups is spared.
  std::span<const std::uint8_t> folded;

  bool is_folded(const PairGroup& group) const {
    return (folded[group.leaf[0]] | folded[group.leaf[1]]) != 0;
  }
};

/// Finds the pairs of a group that may be nearer than the gap before its leaves have moved by the slack.
void find_pairs(const ContactMesh& mesh, const PairSearch& search, PairGroup& group, PairTask& task);

/// Drops the pairs of a group with leaves that may move by `room_m` against each other before a pair is as
/// near as the gap.
void clear_pairs(float room_m, PairGroup& group, PairTask& task);

/// Ends a substep: adds its steps to the travel of all groups, and marks the leaves of folded groups.
void end_groups(const engine::Context& context, std::vector<PairTask>& tasks, std::span<std::uint8_t> folded);

/// Removes unused pairs from a task's list where they are many. Indices of pairs change.
void drop_unused_pairs(PairTask& task);

/// Removes the contacts of this substep where they are many more than pairs, because groups were found anew.
void drop_unused_contacts(PairTask& task);

/// The corners of a pair.
inline Corners corners_of(const Index (&particle)[4], std::span<const Point> at) {
  return {{xyz(load(at[particle[0]])), xyz(load(at[particle[1]])), xyz(load(at[particle[2]])),
           xyz(load(at[particle[3]]))}};
}

}  // namespace bodice::cloth
