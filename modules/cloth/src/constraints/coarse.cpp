// Based on: Matthias Mueller. Hierarchical Position Based Dynamics. 2008.
// Differs: a node has the mass of all particles that it represents, so that momentum is kept. Constraints of
// nodes only pull (they limit distances along the cloth), so that folds stay free. Corrections are
// interpolated, not positions.
#include "constraints/coarse.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <span>

#include <bodice/engine/parallel.hpp>

#include "base/tolerances.hpp"

namespace bodice::inline v0_1::cloth {
namespace {

// The body holds a node that ties pull farther into it than this in a substep. Contact suffices for less,
// which is what a part of a garment does that carries a few times its own mass.
constexpr float kPressed_m = 5e-4f;

// A tie becomes at most a tenth shorter in a substep than it was before, whatever its limit. Ties around a
// body that is too wide for them would otherwise pull cloth deep into it in each substep, from where contact
// throws it back.
constexpr float kLeastOfLength = 0.9f;

// The lengths to which the ties of a pack are pulled.
Float4 target_lengths(const CoarseLevel& level, std::size_t first) {
  const Index *a = &level.ties.a[first], *b = &level.ties.b[first];
  Float4 d[kTiePack];
  for (std::size_t k = 0; k < kTiePack; ++k) d[k] = load(level.before[a[k]]) - load(level.before[b[k]]);
  transpose(d[0], d[1], d[2], d[3]);
  const Float4 least = kLeastOfLength * square_root(d[0] * d[0] + d[1] * d[1] + d[2] * d[2] + kTinyLength2);
  const Float4 limit = load(&level.ties.limit_m[first]);
  return least > limit ? least : limit;
}

// Solves a pack of ties; returns whether one was too long.
bool pull_pack(CoarseLevel& level, std::size_t pack) {
  const std::size_t first = pack * kTiePack;
  const Index *a = &level.ties.a[first], *b = &level.ties.b[first];
  Float4 at_a[kTiePack], at_b[kTiePack], d[kTiePack];
  for (std::size_t k = 0; k < kTiePack; ++k) {
    at_a[k] = load(level.at[a[k]]), at_b[k] = load(level.at[b[k]]);
    d[k] = xyz(at_a[k] - at_b[k]);
  }
  Float4 x = d[0], y = d[1], z = d[2], none = d[3];
  transpose(x, y, z, none);
  const Float4 length2 = x * x + y * y + z * z, limit = load(&level.ties.limit_m[first]);
  if (!any(length2 > limit * limit)) return false;
  const Float4 target = target_lengths(level, first);
  const auto longer = length2 > target * target;
  if (!any(longer)) return false;
  const Float4 wa = weights(at_a[0], at_a[1], at_a[2], at_a[3]);
  const Float4 wb = weights(at_b[0], at_b[1], at_b[2], at_b[3]);
  const Float4 length = square_root(length2 + kTinyLength2);
  const Float4 scale = longer ? (length - target) / (length * (wa + wb + kTinyWeight)) : splat(0.0f);
  const Float4 to_a = scale * wa, to_b = scale * wb;
  for (std::size_t k = 0; k < kTiePack; ++k) {
    store(level.at[a[k]], at_a[k] - to_a[k] * d[k]);
    store(level.at[b[k]], at_b[k] + to_b[k] * d[k]);
  }
  return true;
}

// Makes a sweep over all ties; returns whether one was too long.
bool pull(const engine::Context& context, CoarseLevel& level) {
  const Schedule& schedule = level.ties.schedule;
  std::atomic<bool> pulled{false};
  auto note = [&](bool longer) {
    if (longer && !pulled.load(std::memory_order_relaxed)) pulled.store(true, std::memory_order_relaxed);
  };
  engine::parallel_for(context, schedule.block_begin.size() - 1, 1, [&](std::size_t block, std::size_t) {
    bool longer = false;
    for (std::size_t pack = schedule.block_begin[block]; pack < schedule.block_begin[block + 1]; ++pack)
      longer = pull_pack(level, pack) || longer;
    note(longer);
  });
  for_each_across(context, schedule, [&](std::size_t begin, std::size_t end) {
    bool longer = false;
    for (std::size_t pack = begin; pack < end; ++pack) longer = pull_pack(level, pack) || longer;
    note(longer);
  });
  return pulled.load();
}

// The displacement of particle i, interpolated from the nodes.
Float4 carried(const CoarseLevel& level, std::size_t i) {
  const Parents& parents = level.parents[i];
  Float4 sum = splat(0.0f);
  for (std::size_t k = 0; k < kParents; ++k) sum += parents.share[k] * load(level.move[parents.node[k]]);
  return sum;
}

// The position of particle i after the displacements of the levels so far.
Float4 moved_to(std::span<const CoarseLevel* const> moved, const Particles& p, std::size_t i) {
  Float4 at = load(p.point[i]);
  if (p.point[i].weight == 0.0f) return at;
  for (const CoarseLevel* level : moved) at += carried(*level, i);
  return at;
}

// Takes from the displacement of a node what the body blocks: all of it along -n, and of that along the
// surface as much as friction holds.
Float4 allowed(Float4 displacement, Float4 n, float friction) {
  const float along_n = dot(displacement, n), pressed = std::max(0.0f, -along_n);
  const Float4 slip = displacement - along_n * n;
  const float length = std::sqrt(dot(slip, slip));
  const float kept = length > friction * pressed ? 1.0f - friction * pressed / length : 0.0f;
  return std::max(0.0f, along_n) * n + kept * slip;
}

// Puts nodes back that ties have pulled into the body, and holds them there; true if there is one.
bool hold_supported(const engine::Context& context, const Support& support, CoarseLevel& level) {
  std::atomic<bool> any{false};
  engine::parallel_for(context, level.node.size(), kParticleGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) {
      const Index i = level.node[n];
      if (!support.touching[i]) continue;
      const Float4 from = load(level.move[n]), normal = xyz(load(support.normal[i]));
      const Float4 displacement = xyz(load(level.at[n]) - from);
      if (!(dot(displacement, normal) < -kPressed_m)) continue;
      const float share = support.friction_share.empty() ? 1.0f : support.friction_share[i];
      const Float4 at = from + allowed(displacement, normal, share * support.friction);
      level.at[n] = {at[0], at[1], at[2], 0.0f};
      any.store(true, std::memory_order_relaxed);
    }
  });
  return any.load();
}

// Makes sweeps until all ties are within their limits, when another one would change nothing; true if one was
// too long.
bool pull_together(const engine::Context& context, CoarseLevel& level) {
  bool pulled = false;
  for (int sweep = 0; sweep < level.sweeps && pull(context, level); ++sweep) pulled = true;
  return pulled;
}

void load_nodes(const engine::Context& context, std::span<const CoarseLevel* const> moved, const Particles& p,
                CoarseLevel& level) {
  engine::parallel_for(context, level.node.size(), kParticleGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n) {
      const Float4 from = moved_to(moved, p, level.node[n]);
      store(level.move[n], from);
      level.at[n] = {from[0], from[1], from[2], level.inverse_mass[n]};
      const Index i = level.node[n];
      level.before[n] = {p.old_x[i], p.old_y[i], p.old_z[i], 0.0f};
    }
  });
}

void to_displacements(const engine::Context& context, CoarseLevel& level) {
  engine::parallel_for(context, level.node.size(), kParticleGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t n = begin; n < end; ++n)
      store(level.move[n], xyz(load(level.at[n]) - load(level.move[n])));
  });
}

// The inverse of the mass that node n represents; zero if its own particle is pinned or asleep.
float inverse_mass(const Particles& p, const CoarseLevel& level, std::size_t n) {
  if (!(p.point[level.node[n]].weight > 0.0f)) return 0.0f;
  float mass = 0.0f;
  for (Index k = level.child_begin[n]; k < level.child_begin[n + 1]; ++k) {
    const auto [i, share] = level.child[k];
    const float weight = p.point[i].weight;
    mass += share * (weight > 0.0f ? 1.0f / weight : kPinnedMass * p.mass[i]);
  }
  return 1.0f / mass;
}

}  // namespace

void update_weights(const engine::Context& context, const Particles& p, std::vector<CoarseLevel>& levels) {
  for (CoarseLevel& level : levels) {
    const std::size_t nodes = level.node.size();
    const std::size_t grain = 1 + nodes * kParticleGrain / level.child.size();
    engine::parallel_for(context, nodes, grain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t n = begin; n < end; ++n) level.inverse_mass[n] = inverse_mass(p, level, n);
    });
  }
}

// Nodes of a finer level start at the positions that the coarser levels give; particles follow all levels at
// the end. First all nodes move, which gives what presses them on the body. Those that are held there are
// then fixed for the others: a strap of few particles could not carry a dress otherwise, because ties would
// share each pull by mass and contact would push the strap alone out of the body.
void solve_coarse(const engine::Context& context, const Support& support, std::vector<CoarseLevel>& levels,
                  Particles& p) {
  const CoarseLevel* moved[kMostLevels] = {};
  std::size_t count = 0;
  for (CoarseLevel& level : levels) {
    load_nodes(context, {moved, count}, p, level);
    if (!pull_together(context, level)) continue;
    if (hold_supported(context, support, level)) pull_together(context, level);
    to_displacements(context, level);
    moved[count++] = &level;
  }
  if (count == 0) return;
  engine::parallel_for(context, p.count(), kParticleGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) store(p.point[i], moved_to({moved, count}, p, i));
  });
}

}  // namespace bodice::cloth
