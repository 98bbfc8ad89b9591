#include "selfcontact/strayed_leaves.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "selfcontact/expected_paths.hpp"
#include "selfcontact/self_contact.hpp"

namespace bodice::inline v0_1::cloth {
namespace {

// All groups are searched anew where more than one particle in this many strayed.
constexpr std::size_t kFewStrayed = 200;
// The largest allowance of one particle, in spare distances. Beyond it, a search with a path from its present
// position gives fewer groups.
constexpr float kMostAllowance = 4.0f;
// The number of groups for which memory is reserved, for each leaf.
constexpr std::size_t kWantedALeaf = 2;

// Lists the particles that strayed; returns whether these are few.
bool list_strayed_particles(const Expectation& expected, std::span<const float> deviation2,
                            std::vector<Index>& particles) {
  particles.clear();
  for (Index i = 0; i < deviation2.size(); ++i) {
    if (expected.allows(deviation2[i], i)) continue;
    if (particles.size() * kFewStrayed >= deviation2.size()) return false;
    particles.push_back(i);
  }
  return true;
}

void find_leaves(const ContactMesh& mesh, StrayedLeaves& s) {
  s.leaves.clear();
  for (const Index i : s.particles)
    for (const std::uint32_t face : mesh.star_of(i)) s.leaves.push_back(mesh.leaf_of[face]);
  std::ranges::sort(s.leaves);
  const auto repeated = std::ranges::unique(s.leaves);
  s.leaves.erase(repeated.begin(), repeated.end());
}

bool is_listed(const PairTask& task, std::pair<std::uint32_t, std::uint32_t> leaves) {
  const auto by_leaves = [](const auto& group) { return leaves_of(group); };
  return std::ranges::binary_search(task.groups, leaves, {}, by_leaves) ||
         std::ranges::binary_search(task.clear, leaves, {}, by_leaves);
}

// Lists the groups that the strayed leaves lack, sorted by task, leaf and other leaf.
void list_missing_groups(const SweepTree& tree, float reach_m, const std::vector<PairTask>& tasks,
                         StrayedLeaves& s) {
  s.wanted.clear();
  for (const std::uint32_t own : s.leaves)
    for_each_near_leaf(tree, tree.leaf[own], reach_m, [&](std::size_t near) {
      const auto [leaf, other] = std::minmax({own, static_cast<std::uint32_t>(near)});
      const auto task =
          std::ranges::partition_point(tasks, [leaf](const PairTask& t) { return t.last_leaf <= leaf; });
      const WantedGroup wanted = {static_cast<std::uint32_t>(task - tasks.begin()), leaf, other};
      if (!is_listed(*task, {leaf, other})) s.wanted.push_back(wanted);
    });
  std::ranges::sort(s.wanted);
  const auto repeated = std::ranges::unique(s.wanted);
  s.wanted.erase(repeated.begin(), repeated.end());
}

// Adds the missing groups to those of a task, which stay sorted. Their distances are those when the substep
// began.
void add_missing_groups(std::span<const WantedGroup> wanted, const SelfContact& s,
                        std::vector<PairGroup>& room, PairTask& task) {
  room.clear();
  for (const WantedGroup& w : wanted) {
    const float apart_m =
        distance(sweep_of(s.mesh, w.leaf, {.at = s.before}), sweep_of(s.mesh, w.other, {.at = s.before}));
    room.push_back(new_group(s.mesh, w.leaf, w.other, apart_m - s.gap_m));
  }
  add_groups(room, task);
}

}  // namespace

StrayedLeaves make_strayed_leaves(std::size_t particles, const ContactMesh& mesh) {
  StrayedLeaves s;
  s.particles.reserve(particles / kFewStrayed + 1);
  s.leaves.reserve(mesh.faces.size());
  s.wanted.reserve(kWantedALeaf * mesh.leaves());
  s.groups.reserve(kWantedALeaf * mesh.leaves());
  return s;
}

bool list_groups_of_strayed(float since_s, float most_m, SelfContact& self) {
  StrayedLeaves& s = self.strayed;
  const Expectation expected(since_s, most_m, self);
  if (!self.tree_has_sweeps || !list_strayed_particles(expected, self.paths.deviation2, s.particles))
    return false;
  // Allowances are whole spare distances, because a particle that strayed may soon stray a little farther.
  for (const Index i : s.particles) {
    const float excess_m = std::sqrt(self.paths.deviation2[i]) - most_m;
    if (!(excess_m <= kMostAllowance * self.spare_m)) return false;
    self.paths.allowance_m[i] = self.spare_m * std::ceil(excess_m / self.spare_m);
  }
  find_leaves(self.mesh, s);
  const SweptPoints points{self.paths.start, self.paths.move, self.paths.allowance_m};
  for (const std::uint32_t leaf : s.leaves) refit_leaf(self.mesh, leaf, points, self.tree);
  list_missing_groups(self.tree, self.gap_m + self.spare_m, self.tasks, s);
  for (auto first = s.wanted.begin(); first != s.wanted.end();) {
    const auto last =
        std::find_if(first, s.wanted.end(), [&](const WantedGroup& w) { return w.task != first->task; });
    add_missing_groups({first, last}, self, s.groups, self.tasks[first->task]);
    first = last;
  }
  if (!s.wanted.empty()) self.moved_leaves.indexed = false;
  s.listed += s.wanted.size();
  return true;
}

}  // namespace bodice::cloth
