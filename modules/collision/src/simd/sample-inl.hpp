// The proxy's distance at one vector of particles of a block, among the block's candidates.
#if defined(BODICE_COLLISION_SAMPLE_INL_) == defined(HWY_TARGET_TOGGLE)
#ifdef BODICE_COLLISION_SAMPLE_INL_
#undef BODICE_COLLISION_SAMPLE_INL_
#else
#define BODICE_COLLISION_SAMPLE_INL_
#endif

#include "simd/cull-inl.hpp"
#include "simd/table-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::collision::HWY_NAMESPACE {

struct Sample {
  V distance;   ///< F, metres; what `distance` was at the start where every ellipsoid is farther
  V3 gradient;  ///< unit for plain ellipsoids
  VI owner;
};

/// The tangent-plane bound of candidate c at p.
HWY_INLINE V tangent_bound(const Candidates& c, int i, V3 p) {
  const V3 offset = p - broadcast3(c.middle);
  return hn::MulAdd(
      all(c.nx[i]), offset.x,
      hn::MulAdd(all(c.ny[i]), offset.y, hn::MulAdd(all(c.nz[i]), offset.z, all(c.distance[i]))));
}

/// Plain ellipsoids: the least distance below `below`, and whose.
HWY_INLINE Sample least_distance(const Baked& baked, const Candidates& c, V3 p, V below) {
  Sample best{below, {hn::Zero(f), hn::Zero(f), hn::Zero(f)}, hn::Set(I(), -1)};
  const V slack = all(baked.rounding_m);
  for (int i = 0; i < c.count; ++i) {
    if (hn::AllTrue(f, hn::Gt(tangent_bound(c, i, p), hn::Add(best.distance, slack)))) continue;
    const Foot foot = foot_of(broadcast(baked.ellipsoids[static_cast<std::size_t>(c.index[i])]), p);
    const VI k = hn::Set(I(), c.index[i]);
    const M tie = hn::And(hn::Eq(foot.distance, best.distance), hn::RebindMask(f, hn::Lt(k, best.owner)));
    const M better = hn::Or(hn::Lt(foot.distance, best.distance), tie);
    best.distance = hn::IfThenElse(better, foot.distance, best.distance);
    best.gradient = select(better, foot.normal, best.gradient);
    best.owner = hn::IfThenElse(hn::RebindMask(I(), better), k, best.owner);
  }
  return best;
}

constexpr int kKeptFeet = 8;

/// Relief: every candidate within the blending of the owner, weighted.
HWY_INLINE Sample relief_distance(const Baked& baked, const ReliefTables& relief, const Candidates& c, V3 p,
                                  V below) {
  alignas(64) float distance[kMaxCandidates][16];
  Foot kept[kKeptFeet];
  int kept_of[kKeptFeet];
  int kept_count = 0, near_count = 0;
  int near[kMaxCandidates];
  const V slack = all(baked.rounding_m), blend = all(relief.blend_m);
  Sample best{below, {hn::Zero(f), hn::Zero(f), hn::Zero(f)}, hn::Set(I(), -1)};
  for (int i = 0; i < c.count; ++i) {
    const V window = hn::Add(best.distance, hn::Add(blend, slack));
    if (hn::AllTrue(f, hn::Gt(tangent_bound(c, i, p), window))) continue;
    const Foot foot = foot_of(broadcast(baked.ellipsoids[static_cast<std::size_t>(c.index[i])]), p);
    if (kept_count < kKeptFeet) {
      kept[kept_count] = foot;
      kept_of[kept_count++] = near_count;
    }
    hn::Store(foot.distance, f, distance[near_count]);
    near[near_count++] = i;
    const VI k = hn::Set(I(), c.index[i]);
    const M tie = hn::And(hn::Eq(foot.distance, best.distance), hn::RebindMask(f, hn::Lt(k, best.owner)));
    const M better = hn::Or(hn::Lt(foot.distance, best.distance), tie);
    best.distance = hn::IfThenElse(better, foot.distance, best.distance);
    best.owner = hn::IfThenElse(hn::RebindMask(I(), better), k, best.owner);
  }
  V weights = hn::Zero(f), value = hn::Zero(f);
  V3 gradient = {hn::Zero(f), hn::Zero(f), hn::Zero(f)};
  const V per_blend = all(1.0f / relief.blend_m);
  int next_kept = 0;
  for (int i = 0; i < near_count; ++i) {
    const bool have = next_kept < kept_count && kept_of[next_kept] == i;
    const Foot* foot_kept = have ? &kept[next_kept++] : nullptr;
    const V over = hn::Sub(hn::Load(f, distance[i]), best.distance);
    const V root = hn::Max(hn::Zero(f), hn::NegMulAdd(over, per_blend, all(1.0f)));
    if (hn::AllTrue(f, hn::Eq(root, hn::Zero(f)))) continue;
    const std::size_t k = static_cast<std::size_t>(c.index[near[i]]);
    const Shape s = broadcast(baked.ellipsoids[k]);
    const Corrected one =
        corrected(relief, broadcast(relief.tables[k]), s, foot_kept ? *foot_kept : foot_of(s, p));
    const V weight = hn::Mul(root, root);
    weights = hn::Add(weights, weight);
    value = hn::MulAdd(weight, one.value, value);
    gradient = along(gradient, weight, one.gradient);
  }
  const M owned = hn::RebindMask(f, hn::Gt(best.owner, hn::Set(I(), -1)));
  const M any = hn::And(owned, hn::Gt(weights, hn::Zero(f)));
  const V inverse = hn::Div(all(1.0f), hn::IfThenElse(any, weights, all(1.0f)));
  best.distance = hn::IfThenElse(any, hn::Mul(value, inverse), below);
  best.gradient = scaled(gradient, inverse);
  return best;
}

/// F at p; `below` bounds what is of interest, as a distance to plain ellipsoids.
HWY_INLINE Sample sample(const Baked& baked, const ReliefTables* relief, const Candidates& c, V3 p, V below) {
  return relief ? relief_distance(baked, *relief, c, p, below) : least_distance(baked, c, p, below);
}

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
