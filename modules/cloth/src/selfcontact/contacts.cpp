#include "selfcontact/contacts.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include <bodice/engine/parallel.hpp>

#include "base/tolerances.hpp"
#include "contact/sunk_particles.hpp"

namespace bodice::inline v0_1::cloth {
namespace {

constexpr float kNoPath_m = std::numeric_limits<float>::infinity();
constexpr int kPushes = 2;  // sweeps over the contacts of a substep
// The slack of a search is at least this multiple of the largest step of a leaf. Cloth that constraints and
// contact move to and fro then keeps its pairs of leaves for several substeps.
constexpr float kAhead = 1.5f;

// Parts nearer than a tenth of a micrometer have no normal. Parts that are as near at rest lie at the same
// point in the garment's file.
constexpr float kTouching_m = 1e-7f;

// The least distance to keep, as a share of the gap, for parts that are even nearer at rest.
constexpr float kLeastOfGap = 0.05f;

// No particle moves farther than this multiple of a push. Otherwise the far end of an edge would fly off
// where it alone can move.
constexpr float kMostLever = 4.0f;

// A particle on the body counts as this many times heavier against another layer. The body undoes that
// particle's share of a push, so that with equal masses the outer layer would sink into the inner one.
constexpr float kTouchingMass = 8.0f;

float gap_of(const ContactSource& source, const Pair& pair) {
  const float at_rest = std::sqrt(closest(pair.edges, corners_of(pair.particle, source.rest)).length2);
  if (!(at_rest > kTouching_m)) return 0.0f;
  return std::clamp(at_rest, kLeastOfGap * source.search.gap_m, source.search.gap_m);
}

// Makes the contacts of a group's pairs that may be too near once its leaves have moved by `step_m` against
// each other.
void refresh_group(const ContactSource& source, float step_m, PairGroup& group, PairTask& task) {
  std::vector<PairContact>& contacts = task.contacts[group.inside];
  group.apart_until_m = group.complete_until_m, group.fresh = true;
  for (std::uint32_t k = group.begin; k < group.end; ++k) {
    Pair& pair = task.pairs[k];
    pair.contact = kNoContact;
    if (!(pair.apart_until_m > group.travel_m + step_m)) {
      const PairContact contact = contact_of(source, pair);
      pair.apart_until_m = pair.gap_m == 0.0f ? kNoPath_m : group.travel_m + contact.apart_m - contact.gap_m;
      if (are_loose(pair.particle, pair.edges, source.loose)) {
        // It is tested again when it is no longer loose.
        pair.apart_until_m = std::min(pair.apart_until_m, group.travel_m);
      } else if (pair.apart_until_m < group.travel_m + step_m) {
        pair.contact = static_cast<std::uint32_t>(contacts.size());
        contacts.push_back(contact);
      }
    }
    group.apart_until_m = std::min(group.apart_until_m, pair.apart_until_m);
  }
}

// Pushes a pair apart; returns whether it was too near.
bool push_pair(const PairContact& c, const PairPush& how, std::span<Point> at) {
  Float4 now[4], apart = splat(0.0f), slid = splat(0.0f);
  for (int k = 0; k < 4; ++k) {
    now[k] = load(at[c.particle[k]]);
    apart += c.weight[k] * now[k];
    slid += c.weight[k] * (now[k] - load(how.before[c.particle[k]]));
  }
  const float push = std::min(c.gap_m, c.apart_m + how.recovery_m) - dot(apart, c.normal);
  if (!(push > 0.0f)) return false;
  float yielding[4], all = kTinyWeight, most = 0.0f;
  for (int k = 0; k < 4; ++k) {
    yielding[k] = c.weight[k] * now[k][3] * (how.touching[c.particle[k]] ? 1.0f / kTouchingMass : 1.0f);
    all += c.weight[k] * yielding[k];
    most = std::max(most, std::abs(yielding[k]));
  }
  all = std::max(all, most / kMostLever);
  const Float4 tangent = xyz(slid - dot(slid, c.normal) * c.normal);
  const float slip = std::sqrt(dot(tangent, tangent) + kTinyLength2);
  const float held = std::min(1.0f, how.friction * push / slip);
  const Float4 correction = (push * c.normal - held * tangent) / all;
  for (int k = 0; k < 4; ++k) {
    const Index i = c.particle[k];
    const Float4 to = now[k] + yielding[k] * correction;
    store(at[i], how.guard.empty() ? to : guarded(to, how.resolved[i], how.guard[i]));
  }
  return true;
}

// Calls visit(first, last) for the tasks of each block, blocks in parallel.
template <class Visit>
void for_each_block(const engine::Context& context, const ContactMesh& mesh,
                    const std::vector<PairTask>& tasks, Visit&& visit) {
  const auto first_of = [&](std::size_t block) {
    return std::ranges::partition_point(
        tasks, [&](const PairTask& task) { return mesh.block[task.first_leaf] < block; });
  };
  engine::parallel_for(context, mesh.blocks, 1,
                       [&](std::size_t block, std::size_t) { visit(first_of(block), first_of(block + 1)); });
}

}  // namespace

LeafMove move_of(const ContactMesh& mesh, std::size_t leaf, std::span<const Point> before,
                 std::span<const Point> now) {
  const Float4 far = splat(kNoPath_m);
  LeafMove m = {far, -far, far, -far};
  for (const Index i : mesh.particles_of(leaf)) {
    const Float4 at = load(before[i]), move = load(now[i]) - at;
    m.at_low = min(m.at_low, at), m.at_high = max(m.at_high, at);
    m.low = min(m.low, move), m.high = max(m.high, move);
  }
  return {xyz(m.at_low), xyz(m.at_high), xyz(m.low), xyz(m.high)};
}

PairContact contact_of(const ContactSource& source, Pair& pair) {
  const Closest c = closest(pair.edges, corners_of(pair.particle, source.search.at));
  const float apart_m = std::sqrt(c.length2);
  if (pair.gap_m == kGapUnknown && apart_m < source.search.gap_m) pair.gap_m = gap_of(source, pair);
  float gap_m = pair.gap_m == kGapUnknown ? source.search.gap_m : pair.gap_m;
  if (!(apart_m > kTouching_m)) gap_m = 0.0f;
  PairContact contact{.weight = c.weight,
                      .normal = c.apart / (apart_m + kTouching_m * kTouching_m),
                      .particle = {},
                      .apart_m = apart_m,
                      .gap_m = gap_m,
                      .edges = pair.edges};
  std::ranges::copy(pair.particle, contact.particle);
  return contact;
}

void update_pairs(const ContactSource& source, float step_m, PairGroup& group, PairTask& task) {
  const bool kept = !(group.travel_m + step_m > group.complete_until_m);
  if (kept && !(group.spared && source.search.is_folded(group))) return;
  PairSearch search = source.search;
  search.slack_m = std::max(search.slack_m, kAhead * step_m), search.step_m = step_m;
  group.fresh = false;
  const LeafMove &a = source.moves[group.leaf[0]], &b = source.moves[group.leaf[1]];
  const Float4 apart = max(splat(0.0f), max(a.at_low - b.at_high, b.at_low - a.at_high));
  const float room_m = std::sqrt(dot(apart, apart)) - search.gap_m;
  if (room_m > search.slack_m)
    clear_pairs(room_m, group, task);
  else
    find_pairs(source.mesh, search, group, task);
}

void refresh_contacts(const engine::Context& context, const ContactSource& source,
                      std::vector<PairTask>& tasks) {
  engine::parallel_for(context, tasks.size(), 1, [&](std::size_t t, std::size_t) {
    PairTask& task = tasks[t];
    for (auto& contacts : task.contacts) contacts.clear();
    drop_unused_pairs(task);
    wake_groups(source.mesh, source.deviation_m, task);
    for (PairGroup& group : task.groups) {
      const float step_m = source.step_of(group);
      group.fresh = false;
      update_pairs(source, step_m, group, task);
      if (!(group.apart_until_m > group.travel_m + step_m)) refresh_group(source, step_m, group, task);
    }
  });
}

bool push_crossing_pairs(const PairPush& how, const std::vector<PairTask>& tasks, std::span<Point> at) {
  bool any_pushed = false;
  for (const PairTask& task : tasks)
    for (const PairContact& c : task.held) any_pushed = push_pair(c, how, at) || any_pushed;
  return any_pushed;
}

void push_pairs_apart(const engine::Context& context, const ContactMesh& mesh, const PairPush& how,
                      const std::vector<PairTask>& tasks, std::span<Point> at) {
  for (int sweep = 0; sweep < kPushes; ++sweep) {
    std::atomic<bool> pushed{false};
    const auto push_all = [&](const PairTask& task, bool inside) {
      bool any_pushed = false;
      for (const PairContact& c : task.contacts[inside]) any_pushed = push_pair(c, how, at) || any_pushed;
      if (any_pushed) pushed.store(true, std::memory_order_relaxed);
    };
    for_each_block(context, mesh, tasks, [&](auto first, auto last) {
      for (; first != last; ++first) push_all(*first, true);
    });
    for (const PairTask& task : tasks) push_all(task, false);
    if (!pushed.load()) return;
  }
}

}  // namespace bodice::cloth
