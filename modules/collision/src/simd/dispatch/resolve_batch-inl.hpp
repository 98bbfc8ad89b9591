// Closest-point response of a batch: chooses the surface, and skips batches that nothing is near.
#if defined(BODICE_COLLISION_RESOLVE_BATCH_INL_) == defined(HWY_TARGET_TOGGLE)
#ifdef BODICE_COLLISION_RESOLVE_BATCH_INL_
#undef BODICE_COLLISION_RESOLVE_BATCH_INL_
#else
#define BODICE_COLLISION_RESOLVE_BATCH_INL_
#endif

#include "simd/response/resolve-inl.hpp"
#include "simd/response/surface-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::inline v0_1::collision::HWY_NAMESPACE {

/// Least radius of the ellipsoids with boxes within `window` of the block's box, which includes the
/// particles' paths; 1e30 if there are none.
HWY_INLINE float shortest_radius(const Baked& baked, const Aabb& e, float window) {
  V least = all(1e30f);
  for (std::size_t k = 0; k < baked.cull.shortest.size(); k += kWidth) {
    const M near = hn::Le(box_distance(baked.cull, e, k), all(std::max(window, 0.0f)));
    least = hn::Min(least, hn::IfThenElse(near, hn::LoadU(f, baked.cull.shortest.data() + k), all(1e30f)));
  }
  return hn::GetLane(hn::MinOfLanes(f, least));
}

/// Sets the radius of each block: half the diagonal of its box.
HWY_INLINE void note_radii(const ParticleBatch& batch, BatchResponse& out) {
  for (int begin = 0; begin < batch.count; begin += kBlock) {
    bool in_float_range;
    const int count = std::min(kBlock, batch.count - begin);
    out.radius_m[begin / kBlock] =
        aabb_of_lanes(batch.x + begin, batch.y + begin, batch.z + begin, count, in_float_range).radius;
  }
}

/// Resolves the batch against plain ellipsoids or relief.
template <class Surface>
HWY_INLINE Status resolve_sharp(const ProxyModel& model, const ResponseParameters& parameters,
                                const ParticleBatch& batch, BatchResponse& out) {
  float shortest_m = 0.0f;
  // This is skipped with a candidate cache and without safe positions: the cache detects empty batches, and
  // no limit on paths is needed.
  if (!batch.cache.batch || batch.has_safe) {
    const Aabb e = aabb_of(batch);
    const float bulge_m = model.relief ? model.relief->highest_m + model.relief->blend_m : 0.0f;
    const float travel_m = batch.has_safe ? parameters.travel_m : 0.0f;
    const float window_m = parameters.clearance_m + bulge_m + travel_m;
    shortest_m = shortest_radius(model.baked, e, window_m + model.baked.rounding_m + rounding_over(e));
    if (shortest_m >= 1e30f) {
      note_radii(batch, out);
      return Status::kDone;
    }
  }
  Surface surface(model, parameters);
  return PushOut<Surface>(surface, batch, out, kShortPath * shortest_m, 1e30f).run();
}

/// Resolves the batch against the smooth union of the ellipsoids.
HWY_INLINE Status resolve_filleted(const ProxyModel& model, const ResponseParameters& parameters,
                                   const ParticleBatch& batch, BatchResponse& out) {
  note_radii(batch, out);
  const Aabb e = aabb_of(batch);
  const float travel_m = batch.has_safe ? parameters.travel_m : 0.0f;
  const float window_m = parameters.clearance_m + 2.0f * parameters.blend_m + travel_m;
  const float shortest_m =
      shortest_radius(model.baked, e, window_m + model.baked.rounding_m + rounding_over(e));
  if (shortest_m >= 1e30f) return Status::kDone;
  TangentCandidates candidates;
  if (!cull_for_response(model.baked, batch, window_m, candidates)) return Status::kTooMany;
  if (candidates.count == 0) return Status::kDone;
  FilletedSurface surface{model, parameters, candidates};
  return PushOut<FilletedSurface>(surface, batch, out, kShortPath * shortest_m, candidates.reach_m).run();
}

/// Resolves the batch, with fillets if they are requested and there is no relief.
HWY_INLINE Status resolve_on_surface(const ProxyModel& model, const ResponseParameters& parameters,
                                     const ParticleBatch& batch, BatchResponse& out) {
  if (model.buries()) return resolve_sharp<ReliefSurface<PosedUnion>>(model, parameters, batch, out);
  if (model.relief) return resolve_sharp<ReliefSurface<ReliefUnion>>(model, parameters, batch, out);
  if (parameters.blend_m > 0.0f) return resolve_filleted(model, parameters, batch, out);
  return resolve_sharp<PlainSurface>(model, parameters, batch, out);
}

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
