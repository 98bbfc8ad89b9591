// The pairs of parts of the cloth that may touch: a particle and a triangle, or two edges. Leaves of
// triangles that may come near each other are listed ahead of a stretch of motion; for each two of them,
// their pairs are found anew once the leaves have moved against each other.
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
inline constexpr float kUnsettled = -1.0f;

/// Two parts of the cloth without a common particle.
struct Pair {
  Index particle[4];                   ///< those of A, then those of B (Corners)
  float until_m = 0.0f;                ///< travel of its group up to which it is farther apart than its gap
  float gap_m = kUnsettled;            ///< the distance to keep; kUnsettled: not known yet, 0: left out
  std::uint32_t contact = kNoContact;  ///< its contact in this substep, where its group is fresh
  bool edges = false;
};

/// Two leaves and their pairs.
struct PairGroup {
  std::uint32_t leaf[2];
  std::uint32_t begin = 0, end = 0;  ///< its range in PairTask::pairs
  float travel_m = 0.0f;  ///< bounds how far one leaf's parts moved against the other's since it was listed
  float step_m = 0.0f;    ///< the same in this substep, once find_crossing() looked at it
  float next_m = 0.0f;    ///< travel up to which none of its pairs is nearer than its gap
  float find_m = 0.0f;    ///< travel up to which it has no other pairs that may be
  bool joined = false;    ///< are_joined()
  bool folded = false;    ///< whether its patch was not flat when it was last looked at (flat_for())
  bool spared = false;    ///< whether it has no pairs because its patch was
  bool inside = false;    ///< whether all of its particles are in one block
  bool fresh = false;     ///< whether its pairs' contacts are those of this substep
};

/// Two leaves that need no pairs yet.
struct ClearGroup {
  std::uint32_t leaf[2];
  float room_m;  ///< how much farther apart they are than the gap on the paths expected of them

  /// Whether none of their parts comes nearer than the gap while leaves are off these paths by `off_m`,
  /// #leaves.
  bool holds(std::span<const float> off_m) const { return off_m[leaf[0]] + off_m[leaf[1]] < room_m; }
};

/// What groups are in order of.
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

/// What one worker handles: consecutive leaves of one block with those from their own on.
struct PairTask {
  std::size_t first_leaf = 0, last_leaf = 0;
  std::vector<PairGroup> groups, groups_before;  ///< by leaf, then by the other leaf; those before the search
  std::vector<ClearGroup> clear;                 ///< in the same order
  std::vector<PairGroup> woken;                  ///< room for those that are no longer clear
  std::vector<std::uint32_t> near;               ///< room for a search
  std::vector<Pair> pairs;                       ///< what all groups have, and some that are no longer used
  std::vector<Pair> spare;                       ///< room for the same, for tidy()
  std::size_t used = 0;                          ///< number of pairs in use
  std::vector<PairContact> contacts[2];          ///< [0]: groups across blocks, [1]: groups inside
  std::vector<Tangle> tangles;
  std::vector<std::uint32_t> crossing;  ///< pairs that would cross in this substep
  std::vector<Pair> pressed;            ///< pairs that would, and may, because nothing can part them
  std::vector<PairContact> held;        ///< contacts of all pairs that would have crossed in it
  std::vector<std::uint32_t> folded;    ///< leaves of folded groups when it ended, some several times
};

/// The tasks of a garment.
std::vector<PairTask> make_pair_tasks(const ContactMesh& mesh);

/// A group of two leaves that is listed for the first time, and that are `room_m` farther apart than the gap.
PairGroup new_group(const ContactMesh& mesh, std::size_t leaf, std::size_t other, float room_m);

/// Merges groups, which are in order, into those of a task.
void add_groups(std::span<const PairGroup> groups, PairTask& task);

/// Lists the groups of all leaves that come nearer than `reach_m` on the sweeps of the tree, which bound the
/// expected paths. Leaves that stay apart on these are clear. Other groups that were listed before keep their
/// pairs. New ones have none, and need none until they moved by their distance, less the gap. The result is
/// the same for any number of workers.
void find_groups(const engine::Context& context, const ContactMesh& mesh, const SweepTree& tree,
                 float reach_m, float gap_m, std::vector<PairTask>& tasks);

/// Makes groups of what is no longer clear when leaves are off their expected paths by `off_m`, #leaves.
void wake_groups(const ContactMesh& mesh, std::span<const float> off_m, PairTask& task);

/// What pairs are looked for.
struct PairSearch {
  float gap_m = 0.0f;
  float slack_m = 0.0f;       ///< how far leaves may move against each other until pairs are found anew
  float step_m = 0.0f;        ///< how far they move in this substep
  std::span<const Point> at;  ///< #P: positions
  /// #leaves: 1 for a leaf with a folded group. Triangles between its own may have turned over, so that its
  /// groups are not spared.
  std::span<const std::uint8_t> folded;

  bool is_folded(const PairGroup& group) const {
    return (folded[group.leaf[0]] | folded[group.leaf[1]]) != 0;
  }
};

/// Finds the pairs of a group that may be nearer than the gap before its leaves have moved by the slack.
void find_pairs(const ContactMesh& mesh, const PairSearch& search, PairGroup& group, PairTask& task);

/// Drops the pairs of a group with leaves that may move by `room_m` against each other until any is as near
/// as the gap.
void clear_pairs(float room_m, PairGroup& group, PairTask& task);

/// Ends a substep: adds its steps to the travel of all groups, and notes the leaves with folded groups.
void end_groups(const engine::Context& context, std::vector<PairTask>& tasks, std::span<std::uint8_t> folded);

/// Removes pairs that are no longer used, where these are many. Positions of pairs in the list change.
void tidy(PairTask& task);

/// Forgets the contacts of this substep where they are many more than pairs, because groups were found anew.
void tidy_contacts(PairTask& task);

/// The corners of a pair.
inline Corners corners_of(const Index (&particle)[4], std::span<const Point> at) {
  return {{xyz(load(at[particle[0]])), xyz(load(at[particle[1]])), xyz(load(at[particle[2]])),
           xyz(load(at[particle[3]]))}};
}

}  // namespace bodice::cloth
