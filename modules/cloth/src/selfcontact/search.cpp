#include "selfcontact/search.hpp"

#include "selfcontact/expected_paths.hpp"
#include "selfcontact/tangles.hpp"

namespace bodice::inline v0_1::cloth {
namespace {

// The share of the allowed deviation that a new expected path may leave a particle with.
constexpr float kAllowedByNewPath = 0.9f;

// Lists the groups on the expected paths, and the triangles that cross where these are not known.
void search(const engine::Context& context, SelfContact& s) {
  refit(context, s.mesh, {s.paths.start, s.paths.move, {}}, s.tree);
  if (!s.crossings_known) {
    find_tangles(context, s.mesh, s.tree, s.paths.start, s.tasks, s.tangles);
    loosen(s.mesh, s.tangles, s.paths.start, s.loose);
  }
  s.searched = s.tree_has_sweeps = s.crossings_known = true;
  find_groups(context, s.mesh, s.tree, s.gap_m + s.spare_m, s.gap_m, s.tasks);
  s.moved_leaves.indexed = false;
  s.strayed.listed = 0;
  ++s.report.searches;
}

}  // namespace

void update_groups(const engine::Context& context, const SelfSubstep& substep, std::span<const Point> at,
                   float allowed, SelfContact& s) {
  const float most_m = allowed * s.spare_m, since_s = s.paths.since_s + substep.length_s;
  if (s.searched && !measure_deviations(context, at, since_s, most_m, s)) return;
  if (s.searched && list_groups_of_strayed(since_s, most_m, s)) return;
  expect_paths(context, substep, at, kAllowedByNewPath * most_m, s);
  search(context, s);
  measure_deviations(context, at, substep.length_s, most_m, s);
}

}  // namespace bodice::cloth
