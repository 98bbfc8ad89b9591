#include "selfcontact/self_contact.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

#include <bodice/engine/parallel.hpp>

#include "base/tolerances.hpp"
#include "selfcontact/expected_paths.hpp"
#include "selfcontact/search.hpp"
#include "selfcontact/tangles.hpp"

namespace bodice::inline v0_1::cloth {
namespace {

// The largest gap, as a share of the median edge: neighboring parts of smooth cloth must not be pairs.
constexpr double kMostOfEdge = 0.25;
// The least gap, as a share of the median edge: floats need some room to distinguish sides.
constexpr double kLeastOfEdge = 0.002;
// Shares of the median edge. After a relative motion of kSlackOfEdge pairs are found anew, after an
// unexpected approach of kSpareOfEdge groups. Larger shares mean longer lists, smaller ones more searches.
constexpr double kSlackOfEdge = 0.2, kSpareOfEdge = 1.0;

// The speed at which layers that begin too close move apart: a fold's width in a few frames.
constexpr float kRecovery_m_s = 0.1f;
// The speed at which stretched edges may pull a particle on the body into other layers. Where a crease holds
// cloth, they pull it by several centimeters a substep, and layers over it would be thrown about.
constexpr float kPulled_m_s = 2.5f;
// The speed at which triangles that cross are drawn apart.
constexpr float kUntangle_m_s = 1.0f;

// The deviations that particles may have before and after contacts move them, as shares of the spare
// distance. They stay below a half, because two particles may come nearer to each other by twice as much.
constexpr float kAllowedBeforeContact = 0.4f, kAllowedAfterContact = 0.499f;
// The largest deviations that contact with a still and with a moving body is expected to cause, as shares of
// the spare distance. A moving body brings layers together, and a smaller share would find pairs too late.
constexpr float kExpectedOnStillBody = 0.2f, kExpectedOnMovingBody = 1.0f;
// Pairs that would cross are pushed apart in at most kHeldRounds rounds of kHeldSweeps sweeps each.
constexpr int kHeldRounds = 6, kHeldSweeps = 4;
// After kFirmRounds rounds of zones, a pair may cross if the body presses it from both sides or if it lies
// within one zone. After kMostRounds rounds all particles move together.
constexpr int kFirmRounds = 4, kMostRounds = 16;
// The number of times that guards are set for sinking particles before layers may cross. With 4, folds at the
// waist of a body that squats crossed.
constexpr int kGuardings = 12;

// The distance from the body down to which particles yield where layers would otherwise cross, as a share of
// the thickness. With a share of 0.2, more skin shows between coarse triangles; with 0.5, more layers cross.
constexpr float kThicknessAfterYield = 0.3f;

constexpr std::size_t kMovesATask = 256;

// The most groups of strayed particles, for each leaf, before a frame lists all groups anew.
constexpr std::size_t kMostListedALeaf = 1;

// The most substeps of a frame in which crushed cloth tries in vain to come nearer to the body.
constexpr int kFailedYields = 2;

ContactSource source_of(const SelfContact& s) {
  return {s.mesh, {s.gap_m, s.slack_m, 0.0f, s.before, s.folded}, s.rest, s.moves, s.deviation_m, s.loose};
}

void find_move(std::size_t leaf, SelfContact& s) {
  s.moves[leaf] = move_of(s.mesh, leaf, s.before, s.now);
  s.deviation_m[leaf] = largest_deviation(leaf, s);
}

void find_moves(const engine::Context& context, SelfContact& s) {
  engine::parallel_for(context, s.mesh.leaves(), kMovesATask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t leaf = begin; leaf < end; ++leaf) find_move(leaf, s);
  });
}

void copy_points(const engine::Context& context, const Particles& p, std::vector<Point>& to) {
  engine::parallel_for(context, p.count(), kParticleGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) to[i] = {p.x[i], p.y[i], p.z[i], p.point[i].weight};
  });
}

PairPush push_of(const SelfSubstep& substep, const SelfContact& s) {
  return {substep.friction, kRecovery_m_s * substep.length_s, s.before, substep.touching, {}, {}};
}

// The number of pairs that would cross on the particles' paths to `now`.
std::size_t count_crossing(const engine::Context& context, const SelfSubstep& substep, Room room,
                           SelfContact& s) {
  update_groups(context, substep, s.now, kAllowedAfterContact, s);
  find_moves(context, s);
  forget_moved(s.moved_leaves);
  return find_crossing(context, source_of(s), {s.now, s.zones.guard, s.zones.parent, room}, s.tasks);
}

// The same, where only pairs of leaves that moved since the last count can have changed.
std::size_t count_crossing_again(const engine::Context& context, const SelfSubstep& substep, Room room,
                                 SelfContact& s) {
  const float since_s = s.paths.since_s + substep.length_s;
  if (measure_deviations_of(s.moved_leaves.leaves, s.now, since_s, kAllowedAfterContact * s.spare_m, s))
    return count_crossing(context, substep, room, s);
  for (const std::uint32_t leaf : s.moved_leaves.leaves) find_move(leaf, s);
  const std::size_t count = find_crossing_again(
      context, source_of(s), {s.now, s.zones.guard, s.zones.parent, room}, s.moved_leaves, s.tasks);
  forget_moved(s.moved_leaves);
  return count;
}

// Pushes apart the pairs that would cross, until none would; returns whether that succeeded.
bool separate_pairs(const engine::Context& context, const SelfSubstep& substep, SelfContact& s) {
  const PairPush how = {0.0f, 0.0f, s.before, substep.touching, s.zones.resolved, s.zones.guard};
  for (int round = 0; round < kHeldRounds; ++round) {
    for (const PairTask& task : s.tasks)
      for (const PairContact& c : task.held) note_moved(s.mesh, c.particle, s.moved_leaves);
    for (int sweep = 0; sweep < kHeldSweeps; ++sweep)
      if (!push_crossing_pairs(how, s.tasks, s.now)) break;
    if (count_crossing_again(context, substep, Room::kAmple, s) == 0) return true;
  }
  return false;
}

// Moves the particles of pairs that would cross together, in zones, until no pair would.
void move_in_zones(const engine::Context& context, const SelfSubstep& substep, const Particles& p,
                   SelfContact& s) {
  for (int round = 0; round <= kMostRounds; ++round) {
    if (round < kMostRounds)
      join_zones(s.tasks, p, s.before, s.now, s.zones);
    else
      join_all(p, s.before, s.now, s.zones);
    note_moved(s.mesh, s.zones.members, s.moved_leaves);
    const Room room = round + 1 < kFirmRounds ? Room::kAmple : Room::kScarce;
    if (count_crossing_again(context, substep, room, s) == 0) break;
  }
  s.report.held += s.zones.members.size();
  clear_zones(s.zones);
}

bool any_pressed(const SelfContact& s) {
  return std::ranges::any_of(s.tasks, [](const PairTask& task) { return !task.pressed.empty(); });
}

// Sets guards for particles that sank into the body since its contact; returns whether any did.
bool guard_moved_particles(const engine::Context& context, const ResolvedBody& body, SelfContact& s) {
  s.moved.clear();
  for (Index i = 0; i < s.now.size(); ++i) {
    const Float4 by = load(s.now[i]) - load(s.zones.resolved[i]);
    if (dot(by, by) > 0.0f) s.moved.push_back(i);
  }
  return guard_sunk(context, body, s.moved, s.zones.resolved, s.now, s.zones.guard);
}

// Separates the pairs that would cross, and moves no particle nearer to the body than `body.least_m`; returns
// whether that succeeded. Particles that sank are kept in front of their guards, or put back if they still
// sink.
bool separate_all(const engine::Context& context, const SelfSubstep& substep, const ResolvedBody& body,
                  const Particles& p, SelfContact& s) {
  std::ranges::fill(s.zones.guard, Guard{});
  bool crossing = true;
  for (int round = 0; round <= kGuardings; ++round) {
    if (crossing && !separate_pairs(context, substep, s)) move_in_zones(context, substep, p, s);
    if (!guard_moved_particles(context, body, s)) {
      drop_separated(context, source_of(s), s.now, s.tasks);
      return !any_pressed(s);
    }
    for (const Index i : s.moved)
      store(s.now[i], guarded(load(s.now[i]), s.zones.resolved[i], s.zones.guard[i]));
    note_moved(s.mesh, s.moved, s.moved_leaves);
    crossing = count_crossing_again(context, substep, Room::kAmple, s) > 0;
  }
  for (const Index i : s.moved)
    if (is_guarded(s.zones.guard[i])) s.now[i] = s.zones.resolved[i];
  count_crossing(context, substep, Room::kScarce, s);
  for (PairTask& task : s.tasks)
    for (const std::uint32_t k : task.crossing) task.pressed.push_back(task.pairs[k]);
  return !any_pressed(s);
}

// Separates pairs that would cross. Where the body leaves no room, cloth comes nearer to it than its
// thickness. Where that does not help, layers cross.
void separate(const engine::Context& context, const SelfSubstep& substep, ResolvedBody body,
              const Particles& p, SelfContact& s) {
  std::ranges::copy(s.now, s.zones.resolved.begin());
  body.least_m = body.thickness_m;
  if (separate_all(context, substep, body, p, s) || s.failed_yields >= kFailedYields) return;
  std::ranges::copy(s.zones.resolved, s.now.begin());
  count_crossing(context, substep, Room::kAmple, s);
  body.least_m = kThicknessAfterYield * body.thickness_m;
  if (!separate_all(context, substep, body, p, s)) ++s.failed_yields;
}

// Copies the points that moved to the particles' positions, and adds the displacement over the substep to
// their velocities.
void copy_moved_points(float substep_s, std::span<const Point> at, Particles& p) {
  for (std::size_t i = 0; i < p.count(); ++i) {
    const float dx = at[i].x - p.x[i], dy = at[i].y - p.y[i], dz = at[i].z - p.z[i];
    if (dx == 0.0f && dy == 0.0f && dz == 0.0f) continue;
    p.x[i] = at[i].x, p.y[i] = at[i].y, p.z[i] = at[i].z;
    p.vx[i] += dx / substep_s, p.vy[i] += dy / substep_s, p.vz[i] += dz / substep_s;
  }
}

}  // namespace

SelfContact make_self_contact(const geometry::TriMesh& mesh, const Particles& p, double gap_m,
                              double median_edge_m) {
  SelfContact s;
  s.gap_m = static_cast<float>(std::clamp(gap_m, kLeastOfEdge * median_edge_m, kMostOfEdge * median_edge_m));
  s.slack_m = static_cast<float>(kSlackOfEdge * median_edge_m);
  s.spare_m = static_cast<float>(kSpareOfEdge * median_edge_m);
  s.mesh = make_contact_mesh(mesh);
  s.tree = make_sweep_tree(s.mesh);
  s.tasks = make_pair_tasks(s.mesh);
  s.zones = make_zones(p.count());
  s.loose = make_loose(p.count());
  s.moves.resize(s.mesh.leaves()), s.deviation_m.resize(s.mesh.leaves()), s.folded.resize(s.mesh.leaves());
  s.moved_leaves = make_moved_leaves(s.mesh, s.tasks.size());
  s.strayed = make_strayed_leaves(p.count(), s.mesh);
  s.moved.reserve(p.count()), s.paths.allowance_m.resize(p.count()), s.paths.deviation2.resize(p.count());
  for (auto* points :
       {&s.rest, &s.before, &s.now, &s.paths.start, &s.paths.move, &s.paths.pulled, &s.paths.drift})
    points->resize(p.count());
  for (std::size_t i = 0; i < p.count(); ++i) s.rest[i] = {p.x[i], p.y[i], p.z[i], 0.0f};
  return s;
}

void forget_pairs(SelfContact& s) {
  s.searched = false;
  for (PairTask& task : s.tasks) task.groups.clear(), task.pairs.clear();
  s.moved_leaves.indexed = false;
}

void begin_self_contact(const engine::Context& context, const Particles& p, SelfContact& s) {
  s.report = {};
  s.failed_yields = 0;
  if (s.origin != p.origin) forget_pairs(s);
  // Groups that were added for strayed particles would otherwise stay until the next search.
  if (s.strayed.listed > kMostListedALeaf * s.mesh.leaves()) s.searched = false;
  s.origin = p.origin;
  copy_points(context, p, s.before);
  if (s.tangles.empty()) return;
  // Loose particles may have passed many triangles of other layers since the last frame.
  refit(context, s.mesh, {.at = s.before}, s.tree);
  s.tree_has_sweeps = false;
  find_tangles(context, s.mesh, s.tree, s.before, s.tasks, s.tangles);
  loosen(s.mesh, s.tangles, s.before, s.loose);
}

SelfContactReport report_self_contact(const SelfContact& s) {
  SelfContactReport report = s.report;
  report.crossing = s.tangles.size();
  for (const PairTask& task : s.tasks) report.pairs += task.used;
  return report;
}

void push_apart(const engine::Context& context, const SelfSubstep& substep, SelfContact& s, Particles& p) {
  expect_contact_positions(context, substep,
                           (substep.still_body ? kExpectedOnStillBody : kExpectedOnMovingBody) * s.spare_m, p,
                           s);
  update_groups(context, substep, s.now, kAllowedBeforeContact, s);
  find_moves(context, s);
  refresh_contacts(context, source_of(s), s.tasks);
  hold_back_pulled(context, substep, kPulled_m_s * substep.length_s, p, s);
  push_pairs_apart(context, s.mesh, push_of(substep, s), s.tasks, p.point);
  untangle(s.mesh, s.tangles, {substep.touching, p.inverse_mass, s.loose, kUntangle_m_s * substep.length_s},
           s.now, p.point);
  release_pulled(context, substep, p, s);
}

void hold_apart(const engine::Context& context, const SelfSubstep& substep, const ResolvedBody& body,
                SelfContact& s, Particles& p) {
  copy_points(context, p, s.now);
  if (count_crossing(context, substep, Room::kAmple, s) > 0) {
    separate(context, substep, body, p, s);
    copy_moved_points(substep.length_s, s.now, p);
  }
  if (add_pressed(s.mesh, s.tasks, s.now, s.tangles)) loosen(s.mesh, s.tangles, s.now, s.loose);
  end_groups(context, s.tasks, s.folded);
  s.paths.since_s += substep.length_s;
  update_drift(context, substep.length_s, s);
  std::swap(s.before, s.now);
}

}  // namespace bodice::cloth
