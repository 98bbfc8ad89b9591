#include "pairs/pairs.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include <bodice/engine/parallel.hpp>

#include "pairs/face_pair.hpp"
#include "pairs/near_faces.hpp"

namespace bodice::inline v0_1::cloth {
namespace {

constexpr std::size_t kLeavesATask = 32;
// One engine task ends the groups of this many pair tasks, because that takes about as long as starting an
// engine task.
constexpr std::size_t kTasksTogether = 16;
// The slack of leaves that had no pairs is multiplied by this. Such leaves mostly stay apart for long,
// although their boxes overlap: their triangles are an edge apart.
constexpr float kFartherSlacks = 4.0f;
// Reserved numbers of pairs, for all tasks together and for each, so that few frames allocate; unused memory
// costs nothing.
constexpr std::size_t kPairsAtFirst = 65536, kFewPairs = 2048;
// Leaves are clear if their distance on the expected paths exceeds the gap by this share of a search's reach.
// With less room they would soon need pairs.
constexpr float kLeastRoom = 0.05f;
// The number of unused pairs that a task keeps, besides half as many as it uses.
constexpr std::size_t kUnused = 256;

bool has(const Face& f, Index i) {
  return f.particle[0] == i || f.particle[1] == i || f.particle[2] == i;
}

// A search between two leaves.
struct LeafPair {
  const ContactMesh& mesh;
  const PairSearch& search;
  float reach_m;
  PairTask& task;
  // Lower bound of the distance of the triangles that were tested.
  float apart_m = std::numeric_limits<float>::max();

  // Two edges are not near if their middles are farther apart than half of their lengths and the reach.
  bool are_far(const Corners& c) const {
    const Float4 a = c.at[1] - c.at[0], b = c.at[3] - c.at[2], apart = c.at[0] + c.at[1] - c.at[2] - c.at[3];
    const float far_m = std::sqrt(dot(a, a)) + std::sqrt(dot(b, b)) + 2.0f * reach_m;
    return dot(apart, apart) > far_m * far_m;
  }

  void offer(const Pair& pair) {
    const Corners corners = corners_of(pair.particle, search.at);
    if (pair.edges && are_far(corners)) return;
    if (closest(pair.edges, corners).length2 > reach_m * reach_m) return;
    task.pairs.push_back(pair);
  }

  void offer_particles(const Face& of, const Face& face) {
    for (unsigned k = 0; k < 3; ++k) {
      const Index i = of.particle[k];
      if ((of.particles >> k & 1u) == 0 || has(face, i)) continue;
      offer({.particle = {i, face.particle[0], face.particle[1], face.particle[2]}});
    }
  }

  void offer_edges(const Face& a, const Face& b) {
    for (unsigned k = 0; k < 3; ++k) {
      if ((a.edges >> k & 1u) == 0) continue;
      const Index p = a.particle[k], q = a.particle[(k + 1) % 3];
      for (unsigned l = 0; l < 3; ++l) {
        const Index r = b.particle[l], s = b.particle[(l + 1) % 3];
        if ((b.edges >> l & 1u) == 0 || p == r || p == s || q == r || q == s) continue;
        offer({.particle = {p, q, r, s}, .edges = true});
      }
    }
  }

  void visit(const Face& a, const Face& b) {
    const FacePair faces = face_pair(a, b, search.at);
    const float least_m = faces.common == 0 ? least_apart(faces) : 0.0f;
    apart_m = std::min(apart_m, std::max(least_m, reach_m));
    if (least_m > reach_m || (faces.common > 0 && are_clear(faces, reach_m))) return;
    offer_particles(a, b);
    offer_particles(b, a);
    offer_edges(a, b);
  }
};

float room_between(const SweepTree& tree, std::size_t leaf, std::size_t other) {
  return distance(tree.leaf[leaf], tree.leaf[other]);
}

// Lists the groups of a task; groups that it had before keep their pairs.
void list_groups(const ContactMesh& mesh, const SweepTree& tree, float reach_m, float gap_m, PairTask& task) {
  std::swap(task.groups, task.groups_before);
  task.groups.clear(), task.clear.clear(), task.used = 0;
  auto before = task.groups_before.begin();
  for (std::size_t first = task.first_leaf; first < task.last_leaf; first += kLeavesTogether) {
    const std::size_t last = std::min(first + kLeavesTogether, task.last_leaf);
    const auto list = [&](std::size_t leaf, std::size_t other, float apart_m) {
      const std::pair wanted(static_cast<std::uint32_t>(leaf), static_cast<std::uint32_t>(other));
      if (apart_m - gap_m > kLeastRoom * reach_m) {
        task.clear.push_back({{wanted.first, wanted.second}, apart_m - gap_m});
        return;
      }
      while (before != task.groups_before.end() && leaves_of(*before) < wanted) ++before;
      const bool known = before != task.groups_before.end() && leaves_of(*before) == wanted;
      task.groups.push_back(known ? *before
                                  : new_group(mesh, leaf, other, room_between(tree, leaf, other) - gap_m));
      task.groups.back().fresh = false;
      task.used += task.groups.back().end - task.groups.back().begin;
    };
    for_each_near_leaf(tree, first, last, reach_m, task.near, list);
  }
}

}  // namespace

std::vector<PairTask> make_pair_tasks(const ContactMesh& mesh) {
  std::vector<PairTask> tasks;
  for (std::size_t leaf = 0; leaf < mesh.leaves(); ++leaf) {
    if (tasks.empty() || mesh.block[tasks.back().first_leaf] != mesh.block[leaf] ||
        leaf - tasks.back().first_leaf == kLeavesATask) {
      tasks.emplace_back();
      tasks.back().first_leaf = leaf;
    }
    tasks.back().last_leaf = leaf + 1;
  }
  const std::size_t pairs = std::max(kFewPairs, kPairsAtFirst / tasks.size());
  for (PairTask& task : tasks) {
    task.pairs.reserve(pairs), task.spare.reserve(pairs);
    task.groups.reserve(pairs / 2), task.groups_before.reserve(pairs / 2), task.near.reserve(pairs / 2);
    task.clear.reserve(pairs / 2), task.woken.reserve(pairs / 2);
    task.crossing.reserve(pairs / 4), task.pressed.reserve(pairs / 4);
    task.held.reserve(pairs / 4), task.folded.reserve(pairs);
    for (auto& contacts : task.contacts) contacts.reserve(pairs);
  }
  return tasks;
}

PairGroup new_group(const ContactMesh& mesh, std::size_t leaf, std::size_t other, float room_m) {
  return {.leaf = {static_cast<std::uint32_t>(leaf), static_cast<std::uint32_t>(other)},
          .apart_until_m = room_m,
          .complete_until_m = room_m,
          .joined = are_joined(mesh, leaf, other),
          .inside = mesh.block[leaf] == mesh.block[other] && mesh.block[leaf] != kNoBlock};
}

void add_groups(std::span<const PairGroup> groups, PairTask& task) {
  const auto by_leaves = [](const PairGroup& group) { return leaves_of(group); };
  task.groups_before.clear();
  std::ranges::merge(task.groups, groups, std::back_inserter(task.groups_before), {}, by_leaves, by_leaves);
  std::swap(task.groups, task.groups_before);
}

void wake_groups(const ContactMesh& mesh, std::span<const float> deviation_m, PairTask& task) {
  task.woken.clear();
  for (const ClearGroup& group : task.clear) {
    if (group.holds(deviation_m)) continue;
    task.woken.push_back(new_group(mesh, group.leaf[0], group.leaf[1], 0.0f));
  }
  if (task.woken.empty()) return;
  add_groups(task.woken, task);
  std::erase_if(task.clear, [&](const ClearGroup& group) { return !group.holds(deviation_m); });
}

void find_groups(const engine::Context& context, const ContactMesh& mesh, const SweepTree& tree,
                 float reach_m, float gap_m, std::vector<PairTask>& tasks) {
  engine::parallel_for(context, tasks.size(), 1, [&](std::size_t task, std::size_t) {
    list_groups(mesh, tree, reach_m, gap_m, tasks[task]);
  });
}

void find_pairs(const ContactMesh& mesh, const PairSearch& search, PairGroup& group, PairTask& task) {
  const auto [leaf, other] = group.leaf;
  if (group.joined) {
    const float flat_m = travel_while_flat(mesh, leaf, other, search.at);
    group.folded = !(flat_m > 0.0f);
    group.spared = flat_m > search.step_m && !search.is_folded(group);
    if (group.spared) return clear_pairs(flat_m, group, task);
  }
  const FaceBoxes boxes(mesh, search.at, leaf, other);
  const float room_m = group.joined ? 0.0f : boxes.distance() - search.gap_m;
  if (room_m > search.slack_m) return clear_pairs(room_m, group, task);
  const bool had_none = !group.joined && group.begin == group.end;
  task.used -= group.end - group.begin;
  group.begin = static_cast<std::uint32_t>(task.pairs.size());
  LeafPair leaves{mesh, search, search.gap_m + search.slack_m, task};
  const float far_m = search.gap_m + (had_none ? kFartherSlacks : 1.0f) * search.slack_m;
  boxes.for_each_near(far_m,
                      [&](std::uint32_t a, std::uint32_t b) { leaves.visit(mesh.faces[a], mesh.faces[b]); });
  group.end = static_cast<std::uint32_t>(task.pairs.size());
  if (had_none && group.begin == group.end)
    return clear_pairs(std::min(leaves.apart_m, far_m) - search.gap_m, group, task);
  task.used += group.end - group.begin;
  for (std::uint32_t k = group.begin; k < group.end; ++k) task.pairs[k].apart_until_m = group.travel_m;
  group.complete_until_m = group.travel_m + search.slack_m;
  group.apart_until_m = group.begin == group.end ? group.complete_until_m : group.travel_m;
}

void clear_pairs(float room_m, PairGroup& group, PairTask& task) {
  task.used -= group.end - group.begin;
  group.begin = group.end = 0;
  group.apart_until_m = group.complete_until_m = group.travel_m + room_m;
}

void end_groups(const engine::Context& context, std::vector<PairTask>& tasks,
                std::span<std::uint8_t> folded) {
  engine::parallel_for(context, tasks.size(), kTasksTogether, [&](std::size_t begin, std::size_t end) {
    for (PairTask& task : std::span(tasks).subspan(begin, end - begin)) {
      task.folded.clear();
      for (PairGroup& group : task.groups) {
        group.travel_m += group.step_m;
        if (group.folded) task.folded.insert(task.folded.end(), {group.leaf[0], group.leaf[1]});
      }
    }
  });
  std::ranges::fill(folded, std::uint8_t{0});
  for (const PairTask& task : tasks)
    for (const std::uint32_t leaf : task.folded) folded[leaf] = 1;
}

void drop_unused_pairs(PairTask& task) {
  if (task.pairs.size() <= kUnused + task.used + task.used / 2) return;
  std::vector<Pair>& pairs = task.spare;
  pairs.clear();
  for (PairGroup& group : task.groups) {
    const auto begin = static_cast<std::uint32_t>(pairs.size());
    pairs.insert(pairs.end(), task.pairs.begin() + group.begin, task.pairs.begin() + group.end);
    group.begin = begin, group.end = static_cast<std::uint32_t>(pairs.size());
  }
  std::swap(task.pairs, pairs);
}

void drop_unused_contacts(PairTask& task) {
  if (task.contacts[0].size() + task.contacts[1].size() <= kUnused + 2 * task.used) return;
  for (auto& contacts : task.contacts) contacts.clear();
  for (PairGroup& group : task.groups) group.fresh = false;
}

}  // namespace bodice::cloth
