// The smooth union of plain ellipsoids, which fillets creases: the root F of
//   sum_k max(0, 1 - (d_k - F) / blend)^2 = 1
// It equals d where one ellipsoid is near and never exceeds the least d_k. Its gradient is continuous:
//   sum_k u_k n_k / sum_k u_k, u_k = max(0, 1 - (d_k - F) / blend)
#if defined(BODICE_COLLISION_SMOOTH_UNION_INL_) == defined(HWY_TARGET_TOGGLE)
#ifdef BODICE_COLLISION_SMOOTH_UNION_INL_
#undef BODICE_COLLISION_SMOOTH_UNION_INL_
#else
#define BODICE_COLLISION_SMOOTH_UNION_INL_
#endif

#include "simd/response/tangent_candidates-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::inline v0_1::collision::HWY_NAMESPACE {

/// The distance of the smooth union in each lane.
struct Sample {
  V distance;   ///< F, meters; where every ellipsoid is farther, its initial value
  V3 gradient;  ///< unit length for plain ellipsoids
  VI owner;
};

constexpr int kSmoothSteps = 5;  // Newton on a convex function, from above: quadratic

/// Distances to the candidates that may blend, in the order of their list.
struct Blended {
  alignas(64) float distance[kMaxCandidates][16];
  int of[kMaxCandidates];
  int count = 0;
};

/// The root by Newton's method, starting from the least distance.
HWY_INLINE V smooth_root(const Blended& b, V least, V per_blend) {
  V root = least;
  for (int step = 0; step < kSmoothSteps; ++step) {
    V sum = all(-1.0f), slope = hn::Zero(f);
    for (int i = 0; i < b.count; ++i) {
      const V over = hn::Sub(hn::Load(f, b.distance[i]), root);
      const V u = hn::Max(hn::Zero(f), hn::NegMulAdd(over, per_blend, all(1.0f)));
      sum = hn::MulAdd(u, u, sum);
      slope = hn::Add(slope, u);
    }
    // The slope is that of the sum in units of blend / 2; the owner alone makes it 1.
    const V half_blend = hn::Div(all(0.5f), per_blend);
    root = hn::Sub(root, hn::Div(hn::Mul(half_blend, sum), hn::Max(slope, all(1e-3f))));
  }
  return hn::Min(root, least);
}

/// Distance, gradient and owner of the smooth union where an ellipsoid is nearer than `below`.
HWY_INLINE Sample smooth_distance(const Baked& baked, float blend_m, const TangentCandidates& c, V3 p,
                                  V below) {
  Blended blended;
  const V slack = all(c.slack_m), blend = all(blend_m), per_blend = all(1.0f / blend_m);
  Sample best{below, {hn::Zero(f), hn::Zero(f), hn::Zero(f)}, hn::Set(I(), -1)};
  for (int i = 0; i < c.count; ++i) {
    const V window = hn::Add(best.distance, hn::Add(blend, slack));
    if (hn::AllTrue(f, hn::Gt(tangent_bound(c, i, p), window))) continue;
    const ClosestPointLanes closest =
        closest_point(broadcast(baked.ellipsoids[static_cast<std::size_t>(c.index[i])]), p);
    hn::Store(closest.distance, f, blended.distance[blended.count]);
    blended.of[blended.count++] = c.index[i];
    const M better = hn::Lt(closest.distance, best.distance);
    best.distance = hn::IfThenElse(better, closest.distance, best.distance);
    best.owner = hn::IfThenElse(hn::RebindMask(I(), better), hn::Set(I(), c.index[i]), best.owner);
  }
  const M owned = hn::RebindMask(f, hn::Gt(best.owner, hn::Set(I(), -1)));
  const V root = smooth_root(blended, best.distance, per_blend);
  V weights = hn::Zero(f);
  V3 gradient = {hn::Zero(f), hn::Zero(f), hn::Zero(f)};
  for (int i = 0; i < blended.count; ++i) {
    const V over = hn::Sub(hn::Load(f, blended.distance[i]), root);
    const V u = hn::Max(hn::Zero(f), hn::NegMulAdd(over, per_blend, all(1.0f)));
    if (hn::AllTrue(f, hn::Eq(u, hn::Zero(f)))) continue;
    const Shape shape = broadcast(baked.ellipsoids[static_cast<std::size_t>(blended.of[i])]);
    weights = hn::Add(weights, u);
    gradient = add_scaled(gradient, u, normal_of(shape, closest_point(shape, p)));
  }
  const V inverse = hn::Div(all(1.0f), hn::Max(weights, all(1e-3f)));
  best.distance = hn::IfThenElse(owned, root, below);
  best.gradient = scaled(gradient, inverse);
  return best;
}

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
