#include "selfcontact/zones.hpp"

#include <algorithm>
#include <numeric>

#include <bodice/engine/parallel.hpp>

#include "contact/sunk_particles.hpp"

namespace bodice::inline v0_1::cloth {
namespace {

// The least distance that a pair may have after a substep: this share of its distance before, or of its gap,
// whichever is less.
constexpr float kKept = 0.2f, kKeptOfGap = 0.02f;
// Parts that the body presses together for many substeps come no nearer than kNear_m; parts that are nearer
// keep this share of their distance. kNear_m is a hundred times the rounding of a position, so that normals
// are still right. Contact cannot hold parts apart without a normal, as those nearer than kTouching_m.
constexpr float kNear_m = 5e-6f, kKeptOfNear = 0.9f;

// The distance to which pairs that would cross are pushed apart, as a share of their gap.
constexpr float kHeldOfGap = 0.1f;

// The most sweeps over the guarded particles of zones, and the lift that does not need another sweep. With
// three sweeps, a zone on the curve of a hip still sank, so that it crossed itself.
constexpr int kMostLifts = 30;
constexpr float kLifted_m = 1e-7f;

// The number of pair tasks that one engine task tests again, because few of their groups moved.
constexpr std::size_t kTasksAgain = 4;

// The factor on a pin's mass in the mean displacement of a zone, which then moves as the pin, up to rounding.
constexpr float kPinnedMassInZone = 1e7f;

// The root of a particle's zone; for a particle without a zone, the particle.
Index zone_of(Index i, std::span<const Index> zone) {
  while (zone[i] != i && zone[i] != geometry::kNoIndex) i = zone[i];
  return i;
}

bool are_of_one_zone(const Index (&particle)[4], std::span<const Index> zone) {
  const Index first = zone_of(particle[0], zone);
  return std::ranges::all_of(particle, [&](Index i) { return zone_of(i, zone) == first; });
}

// Whether a pair can be separated, so that it must not cross. Both of its parts are `backed` where pins or
// the body leave neither room to move.
bool can_be_separated(const PairContact& c, const CrossingSearch& how) {
  if (how.room == Room::kAmple)
    return std::ranges::any_of(c.particle, [&](Index i) { return how.now[i].weight > 0.0f; });
  if (are_of_one_zone(c.particle, how.zone)) return false;
  const int split = c.edges ? 2 : 1;
  bool backed[2] = {false, false};
  for (int k = 0; k < 4; ++k) {
    const Index i = c.particle[k];
    const float along = dot(load(how.guard[i]), k < split ? -c.normal : c.normal);
    backed[k >= split] = backed[k >= split] || !(how.now[i].weight > 0.0f) || along > 0.0f;
  }
  return !(backed[0] && backed[1]);
}

float least_distance(const PairContact& c) {
  return std::max(std::min(kKept * c.apart_m, kKeptOfGap * c.gap_m),
                  std::min(kKeptOfNear * c.apart_m, kNear_m));
}

bool would_cross(const PairContact& c, const ContactSource& source, std::span<const Point> now) {
  const float least_m = least_distance(c);
  const Corners to = corners_of(c.particle, now);
  if (separation(c.edges, to, c.normal) > least_m) return false;
  const Corners from = corners_of(c.particle, source.search.at);
  Corners by;
  for (int k = 0; k < 4; ++k) by.at[k] = to.at[k] - from.at[k];
  return may_meet(c.edges, from, by, least_m);
}

// The contact of a pair when the substep began, which is computed at the first call.
const PairContact& known_contact(const ContactSource& source, const PairGroup& group, Pair& pair,
                                 PairTask& task) {
  std::vector<PairContact>& contacts = task.contacts[group.inside];
  if (pair.contact == kNoContact) {
    pair.contact = static_cast<std::uint32_t>(contacts.size());
    contacts.push_back(contact_of(source, pair));
  }
  return contacts[pair.contact];
}

void find_crossing_in(const ContactSource& source, const CrossingSearch& how, PairGroup& group,
                      PairTask& task) {
  const float step_m = group.step_m = source.step_of(group);
  update_pairs(source, step_m, group, task);
  if (group.apart_until_m > group.travel_m + step_m) return;
  if (!group.fresh)
    for (std::uint32_t k = group.begin; k < group.end; ++k) task.pairs[k].contact = kNoContact;
  group.fresh = true;
  for (std::uint32_t k = group.begin; k < group.end; ++k) {
    Pair& pair = task.pairs[k];
    if (pair.apart_until_m > group.travel_m + step_m) continue;
    if (are_loose(pair.particle, pair.edges, source.loose)) continue;
    const PairContact& contact = known_contact(source, group, pair, task);
    if (!(contact.gap_m > 0.0f) || step_m < contact.apart_m - least_distance(contact)) continue;
    if (!would_cross(contact, source, how.now)) continue;
    if (!can_be_separated(contact, how)) {
      task.pressed.push_back(pair);
      continue;
    }
    task.crossing.push_back(k);
    task.held.push_back(contact);
    task.held.back().gap_m *= kHeldOfGap;
  }
}

std::size_t count_all_crossing(const std::vector<PairTask>& tasks) {
  return std::transform_reduce(tasks.begin(), tasks.end(), std::size_t{0}, std::plus<>(),
                               [](const PairTask& task) { return task.crossing.size(); });
}

Index root_of(Index i, std::vector<Index>& parent) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

// Adds a particle to the zones, as one of its own.
void add_to_zones(Index i, std::span<const Point> before, std::span<const Point> now, Zones& z) {
  if (z.parent[i] != geometry::kNoIndex) return;
  z.parent[i] = i;
  z.members.push_back(i);
  Point wanted;
  store(wanted, load(now[i]) - load(before[i]));
  z.wanted.push_back(wanted);
}

// Moves zones out of the body until none of their guarded particles sinks. Where the body presses a zone from
// two sides, some still sink after the last sweep.
void lift_zones(std::span<const Point> before, Zones& z) {
  bool lifted = true;
  for (int sweep = 0; lifted && sweep < kMostLifts; ++sweep) {
    lifted = false;
    for (const Index i : z.members) {
      if (!is_guarded(z.guard[i])) continue;
      Float4& moved = z.moved[root_of(i, z.parent)];
      const Float4 to = xyz(load(before[i])) + moved, lift = xyz(guarded(to, z.resolved[i], z.guard[i]) - to);
      moved += lift;
      lifted = lifted || dot(lift, lift) > kLifted_m * kLifted_m;
    }
  }
}

void move_zones(const Particles& p, std::span<const Point> before, std::span<Point> now, Zones& z) {
  for (const Index i : z.members) z.moved[i] = splat(0.0f);
  for (std::size_t k = 0; k < z.members.size(); ++k) {
    const Index i = z.members[k];
    const float mass = now[i].weight > 0.0f ? p.mass[i] : kPinnedMassInZone * p.mass[i];
    Float4 moved = load(z.wanted[k]);
    moved[3] = 1.0f;
    z.moved[root_of(i, z.parent)] += mass * moved;
  }
  for (const Index i : z.members)
    if (root_of(i, z.parent) == i) z.moved[i] = xyz(z.moved[i] / z.moved[i][3]);
  lift_zones(before, z);
  for (const Index i : z.members) {
    const float weight = now[i].weight;
    if (!(weight > 0.0f)) continue;
    const Float4 to = xyz(load(before[i])) + z.moved[root_of(i, z.parent)];
    store(now[i], guarded(to, z.resolved[i], z.guard[i]));
    now[i].weight = weight;
  }
}

}  // namespace

Zones make_zones(std::size_t particles) {
  Zones z;
  z.parent.assign(particles, geometry::kNoIndex);
  z.moved.resize(particles), z.resolved.resize(particles), z.guard.resize(particles);
  z.members.reserve(particles), z.wanted.reserve(particles);
  return z;
}

std::size_t find_crossing(const engine::Context& context, const ContactSource& source,
                          const CrossingSearch& how, std::vector<PairTask>& tasks) {
  engine::parallel_for(context, tasks.size(), 1, [&](std::size_t t, std::size_t) {
    PairTask& task = tasks[t];
    task.crossing.clear(), task.held.clear(), task.pressed.clear();
    drop_unused_pairs(task), drop_unused_contacts(task);
    wake_groups(source.mesh, source.deviation_m, task);
    for (PairGroup& group : task.groups) find_crossing_in(source, how, group, task);
  });
  return count_all_crossing(tasks);
}

std::size_t find_crossing_again(const engine::Context& context, const ContactSource& source,
                                const CrossingSearch& how, MovedLeaves& moved, std::vector<PairTask>& tasks) {
  for (PairTask& task : tasks) task.crossing.clear(), task.held.clear();
  const std::span<const std::uint32_t> again = tasks_of_moved(tasks, moved);
  engine::parallel_for(context, again.size(), kTasksAgain, [&](std::size_t begin, std::size_t end) {
    for (const std::uint32_t t : again.subspan(begin, end - begin)) {
      PairTask& task = tasks[t];
      // Where cloth is pinched, rounds find the same groups many times.
      drop_unused_pairs(task), drop_unused_contacts(task);
      wake_groups(source.mesh, source.deviation_m, task);
      for (PairGroup& group : task.groups)
        if (moved.has_moved(group)) find_crossing_in(source, how, group, task);
    }
  });
  return count_all_crossing(tasks);
}

void drop_separated(const engine::Context& context, const ContactSource& source, std::span<const Point> now,
                    std::vector<PairTask>& tasks) {
  engine::parallel_for(context, tasks.size(), 1, [&](std::size_t t, std::size_t) {
    std::erase_if(tasks[t].pressed,
                  [&](Pair& pair) { return !would_cross(contact_of(source, pair), source, now); });
  });
}

void join_zones(const std::vector<PairTask>& tasks, const Particles& p, std::span<const Point> before,
                std::span<Point> now, Zones& z) {
  for (const PairTask& task : tasks)
    for (const std::uint32_t k : task.crossing) {
      const Index(&particle)[4] = task.pairs[k].particle;
      for (const Index i : particle) add_to_zones(i, before, now, z);
      for (const Index i : particle) z.parent[root_of(i, z.parent)] = root_of(particle[0], z.parent);
    }
  move_zones(p, before, now, z);
}

void join_all(const Particles& p, std::span<const Point> before, std::span<Point> now, Zones& z) {
  for (Index i = 0; i < p.count(); ++i) {
    add_to_zones(i, before, now, z);
    z.parent[root_of(i, z.parent)] = root_of(0, z.parent);
  }
  move_zones(p, before, now, z);
}

void clear_zones(Zones& z) {
  for (const Index i : z.members) z.parent[i] = geometry::kNoIndex;
  z.members.clear(), z.wanted.clear();
}

}  // namespace bodice::cloth
