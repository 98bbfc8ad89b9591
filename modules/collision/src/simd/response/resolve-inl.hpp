// Closest-point response of a batch: a query at the particles, a push of those below the clearance, and
// further queries and pushes until all are clear. What three half-spaces, or a few Newton steps, do not
// settle is left to the exact side.
#if defined(BODICE_COLLISION_RESOLVE_INL_) == defined(HWY_TARGET_TOGGLE)
#ifdef BODICE_COLLISION_RESOLVE_INL_
#undef BODICE_COLLISION_RESOLVE_INL_
#else
#define BODICE_COLLISION_RESOLVE_INL_
#endif

#include "simd/response/cutting_planes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::collision::HWY_NAMESPACE {

// Longer pushes, in multiples of the depth, come from surfaces that nearly face each other and are left to
// the exact side.
constexpr float kLongestPush = static_cast<float>(collision::kLongestPush);
// A path shorter than this fraction of the least radius nearby neither passes through an ellipsoid nor
// changes sides.
constexpr float kShortPath = static_cast<float>(kLongPath);
constexpr float kOvershootOfStep = static_cast<float>(kStepOvershoot);

/// A plane of the contact at x, active only if x lies on it. Elsewhere its normal is zero, so that it does
/// not restrict velocities.
HWY_INLINE Plane touching(const Plane& plane, M active, V3 x, float within_m, M& there) {
  there = hn::And(active, hn::Ge(plane.gap(x), all(-within_m)));
  const V zero = hn::Zero(f);
  return {select(there, plane.n, {zero, zero, zero}), zero};
}

HWY_INLINE Plane touching(const float* nx, const float* ny, const float* nz, const float* offset, int i,
                          const std::int32_t* of, V3 x, float within_m, M& there) {
  const Plane plane = {load3(nx + i, ny + i, nz + i), hn::Load(f, offset + i)};
  const M active = hn::RebindMask(f, hn::Gt(hn::Load(I(), of + i), hn::Set(I(), -1)));
  return touching(plane, active, x, within_m, there);
}

/// The closest velocity that leads into none of the contact's planes at x. Even the first plane may have been
/// left behind, except on a nonconvex surface, which has one plane: the tangent plane at x.
HWY_INLINE V3 closest_velocity(const PushState& state, int i, V3 x, bool nonconvex, float slack_m, V3 v) {
  const V3 n = load3(state.n1x + i, state.n1y + i, state.n1z + i);
  if (nonconvex) return add_scaled(v, hn::Max(hn::Neg(dot(n, v)), hn::Zero(f)), n);
  M one, two, three;
  const float within_m = 4.0f * slack_m;
  const Plane pushed_first = {n, hn::Load(f, state.offset1 + i)};
  const Plane first = touching(pushed_first, hn::FirstN(f, kWidth), x, within_m, one);
  const Plane second =
      touching(state.n2x, state.n2y, state.n2z, state.offset2, i, state.ellipsoid2, x, within_m, two);
  const Plane third =
      touching(state.n3x, state.n3y, state.n3z, state.offset3, i, state.ellipsoid3, x, within_m, three);
  const V3 of_two = project(first, second, two, v);
  if (hn::AllFalse(f, three)) return of_two;
  const V zero = hn::Zero(f);
  const V3 of_other = project(first, third, three, v);
  const V3 of_three = select(hn::Le(third.gap(of_two), zero), of_two, project(first, second, third, v, zero));
  return select(three, select(two, of_three, of_other), of_two);
}

/// Removes the inward velocity and slows the rest by Coulomb friction; restitution is 0.
HWY_INLINE V3 corrected_velocity(V3 along_surface, float friction, V3 v) {
  const V3 change = along_surface - v;
  const V impulse2 = dot(change, change), speed2 = dot(along_surface, along_surface);
  const V ratio = hn::Sqrt(hn::Div(impulse2, hn::Max(speed2, all(1e-30f))));
  return scaled(along_surface, hn::Max(hn::Zero(f), hn::NegMulAdd(all(friction), ratio, all(1.0f))));
}

/// Velocity of the body's material at x, moving with ellipsoid `owner`; lanes without an owner read the first
/// ellipsoid.
HWY_INLINE V3 surface_velocity(const SurfaceMotion* motion, VI owner, V3 x) {
  constexpr int kStride = sizeof(SurfaceMotion) / sizeof(float);
  const VI at = hn::Mul(hn::Max(owner, hn::Zero(I())), hn::Set(I(), kStride));
  const float* base = motion->linear;  // linear, then translation, without padding
  const V3 r0 = {hn::GatherIndex(f, base, at), hn::GatherIndex(f, base + 1, at),
                 hn::GatherIndex(f, base + 2, at)};
  const V3 r1 = {hn::GatherIndex(f, base + 3, at), hn::GatherIndex(f, base + 4, at),
                 hn::GatherIndex(f, base + 5, at)};
  const V3 r2 = {hn::GatherIndex(f, base + 6, at), hn::GatherIndex(f, base + 7, at),
                 hn::GatherIndex(f, base + 8, at)};
  const V3 translation = {hn::GatherIndex(f, base + 9, at), hn::GatherIndex(f, base + 10, at),
                          hn::GatherIndex(f, base + 11, at)};
  return V3{dot(r0, x), dot(r1, x), dot(r2, x)} + translation;
}

/// Paths longer than the limit, relative to the ellipsoid that owns the particle. Without an owner any
/// ellipsoid may have passed by, so that the limit is reduced by the body's displacement.
HWY_INLINE M is_long_path(V3 path, const ResponseParameters& parameters, V3 p, VI owner, float limit_m) {
  V limit = all(limit_m);
  if (parameters.motion) {
    const V3 carried = scaled(surface_velocity(parameters.motion, owner, p), all(parameters.dt_s));
    const M owned = hn::RebindMask(f, hn::Gt(owner, hn::Set(I(), -1)));
    path = select(owned, path - carried, path);
    limit = hn::IfThenElse(owned, limit, all(std::max(0.0f, limit_m - parameters.travel_m)));
  }
  return hn::Ge(dot(path, path), hn::Mul(limit, limit));
}

/// Flags paths longer than the limit, by the bound that holds for any ellipsoid.
HWY_INLINE void find_long_paths(const ParticleBatch& batch, const ResponseParameters& parameters,
                                float short_path_m, LaneBits& out) {
  const float travel_m = parameters.motion ? parameters.travel_m : 0.0f;
  const V limit = all(std::max(0.0f, short_path_m - travel_m));
  for (int i = 0; i < batch.count; i += kWidth) {
    const V3 path =
        load3(batch.x + i, batch.y + i, batch.z + i) - load3(batch.sx + i, batch.sy + i, batch.sz + i);
    const M far = hn::Ge(dot(path, path), hn::Mul(limit, limit));
    out.add(bits(hn::And(far, lanes_below(i, batch.count))), i);
  }
}

/// The safe positions of these lanes; -1 reads lane 0.
HWY_INLINE V3 safe_positions_of(const ParticleBatch& batch, VI lanes) {
  return gather3(batch.sx, batch.sy, batch.sz, hn::Max(lanes, hn::Zero(I())));
}

/// Calls work for each lane of the mask with its particle, and whether the lane is in `which`.
template <class Work>
HWY_INLINE void for_particles(M mask, M which, const std::int32_t* lane, Work&& work) {
  const std::uint64_t chosen = bits(which);
  for (std::uint64_t left = bits(mask); left != 0; left &= left - 1) {
    const int k = std::countr_zero(left);
    work(lane[k], (chosen >> k & 1) != 0);
  }
}

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

/// First push of the particles that are below the clearance and have a short path; `contacts` gets a bit for
/// each. Those with a long path are left to the exact side.
HWY_INLINE void push_first(const Surface& surface, const ParticleBatch& batch, float short_path_m,
                           const InRange& in_range, const BatchResults& found, int i, PushState& state,
                           PushedLanes& pushed, LaneBits& contacts, BatchResponse& out) {
  const ResponseParameters& parameters = surface.parameters;
  const V3 p = load3(in_range.x + i, in_range.y + i, in_range.z + i);
  const V3 normal = load3(found.gx + i, found.gy + i, found.gz + i);
  const V distance = hn::Load(f, found.distance + i);
  const VI lanes = hn::Load(I(), in_range.lane + i);
  M contact = hn::And(hn::RebindMask(f, hn::Gt(lanes, hn::Set(I(), -1))),
                      hn::Lt(distance, all(parameters.clearance_m)));
  const VI proxy_index =
      hn::IfThenElseZero(hn::RebindMask(I(), contact), hn::Load(I(), found.proxy_index + i));
  const VI nearest_one = hn::GatherIndex(I(), surface.baked.internal_index.data(), proxy_index);
  const VI owner = hn::IfThenElse(hn::RebindMask(I(), contact), nearest_one, hn::Set(I(), -1));
  if (batch.has_safe) {
    const M far = is_long_path(p - safe_positions_of(batch, lanes), parameters, p, owner, short_path_m);
    for_particles(contact, far, in_range.lane + i,
                  [&](int lane, bool is) { out.left_to_exact.set(lane, is); });
    contact = hn::AndNot(far, contact);
  }
  hn::Store(owner, I(), state.owner + i);
  store3(normal, state.n1x + i, state.n1y + i, state.n1z + i);
  const V target = surface.nonconvex() ? all(surface.target_m()) : plain_target(surface, owner);
  const V short_by = hn::Sub(target, distance);
  const V over = all(surface.relief ? kOvershootOfStep : 0.0f);
  const V beyond = hn::MulAdd(over, hn::Max(short_by, hn::Zero(f)), target);
  const V3 x = surface.nonconvex() ? newton_step(p, distance, normal, hn::Load(f, found.value + i), beyond)
                                   : add_scaled(p, short_by, normal);
  store3(select(contact, x, p), state.x + i, state.y + i, state.z + i);
  hn::Store(hn::Add(dot(normal, p), short_by), f, state.offset1 + i);
  contacts.add(bits(contact), i);
  pushed.add(contact, lanes_from(i), x, owner);
}

HWY_INLINE M mask_of(const LaneBits& lanes, int i) {
  const std::uint64_t shifted = lanes.from(i);
  std::uint8_t bytes[8];
  std::memcpy(bytes, &shifted, sizeof(bytes));
  return hn::LoadMaskBits(f, bytes);
}

/// The velocity after the contact.
HWY_INLINE V3 velocity_after(const Surface& surface, const ParticleBatch& batch, const PushState& state,
                             int i, VI lanes, VI owner, V3 p, V3 position) {
  const ResponseParameters& parameters = surface.parameters;
  const V3 v = gather3(batch.vx, batch.vy, batch.vz, hn::Max(lanes, hn::Zero(I())));
  V3 body = {hn::Zero(f), hn::Zero(f), hn::Zero(f)};
  if (parameters.motion) body = surface_velocity(parameters.motion, owner, p);
  const V3 relative = v - body;
  const V3 along_surface =
      closest_velocity(state, i, position, surface.nonconvex(), parameters.slack_m, relative);
  return corrected_velocity(along_surface, parameters.friction, relative) + body;
}

/// Writes the results of one vector of contacts; those with a long push or still below the clearance are left
/// to the exact side.
HWY_INLINE void write_responses(const Surface& surface, float reach_m, const InRange& in_range,
                                const BatchResults& found, const PushState& state, M contact, int i,
                                const ParticleBatch& batch, V& deepest, BatchResponse& out) {
  const ResponseParameters& parameters = surface.parameters;
  const VI lanes = hn::Load(I(), in_range.lane + i);
  const V3 p = load3(in_range.x + i, in_range.y + i, in_range.z + i);
  const V3 pushed_to = load3(state.x + i, state.y + i, state.z + i);
  const V3 push = pushed_to - p;
  const V length2 = dot(push, push);
  const V depth = hn::Sub(all(parameters.clearance_m), hn::Load(f, found.distance + i));
  const VI owner = hn::Load(I(), state.owner + i);
  const V longest = hn::Min(all(reach_m), hn::MulAdd(all(kLongestPush), depth, all(parameters.slack_m)));
  const M hard = hn::And(contact, hn::Or(hn::Gt(length2, hn::Mul(longest, longest)), mask_of(state.open, i)));
  for_particles(hard, hard, in_range.lane + i, [&](int lane, bool) { out.left_to_exact.set(lane, true); });
  contact = hn::AndNot(hard, contact);
  V limit = all(parameters.max_push_m);
  if (batch.has_safe) {
    const V3 path = p - safe_positions_of(batch, lanes);
    limit = hn::Add(limit, hn::Sqrt(dot(path, path)));
  }
  const M pending = hn::And(contact, hn::Gt(length2, hn::Mul(limit, limit)));
  V3 position = pushed_to;
  if (!hn::AllFalse(f, pending)) {
    const V share = hn::Div(limit, hn::Sqrt(hn::Max(length2, all(1e-30f))));
    position = select(pending, add_scaled(p, share, push), pushed_to);
  }
  const Pack pack(contact);
  const auto store = [&](V3 v, float* x, float* y, float* z) {
    pack.store(v.x, x + out.count);
    pack.store(v.y, y + out.count);
    pack.store(v.z, z + out.count);
  };
  store(position, out.x, out.y, out.z);
  if (batch.has_velocity)
    store(velocity_after(surface, batch, state, i, lanes, owner, p, pushed_to), out.vx, out.vy, out.vz);
  pack.store(lanes, out.lane + out.count);
  pack.store(owner, out.owner + out.count);
  out.count += pack.count();
  out.pending += static_cast<int>(hn::CountTrue(f, pending));
  deepest = hn::Max(deepest, hn::IfThenElseZero(contact, depth));
}

/// Resolves the batch against one surface; pushes longer than `reach_m` are left to the exact side.
HWY_INLINE bool resolve_on(const Surface& surface, float short_path_m, float reach_m,
                           const ParticleBatch& batch, BatchResponse& out) {
  InRange in_range;
  BatchResults found;
  QueryBatch query = batch_at(batch.x, batch.y, batch.z, batch.count);
  query.cache = batch.cache;
  query.next_batch = batch.next_batch;
  PushState state;
  PushedLanes pushed;
  LaneBits contacts;
  state.clear_others();
  std::copy_n(out.radius_m, kBlocks, query.radius_m);
  if (!measure_first(surface, query, in_range, found)) return false;
  std::copy_n(query.radius_m, kBlocks, out.radius_m);
  if (batch.has_safe) find_long_paths(batch, surface.parameters, short_path_m, out.left_to_exact);
  for (int i = 0; i < in_range.count; i += kWidth)
    push_first(surface, batch, short_path_m, in_range, found, i, state, pushed, contacts, out);
  if (contacts.none()) return true;
  if (!push_until_clear(surface, in_range, batch.has_velocity, pushed, state)) return false;
  V deepest = hn::Zero(f);
  for (int i = 0; i < in_range.count; i += kWidth) {
    const M contact = mask_of(contacts, i);
    if (hn::AllFalse(f, contact)) continue;
    write_responses(surface, reach_m, in_range, found, state, contact, i, batch, deepest, out);
  }
  out.deepest_m = hn::GetLane(hn::MaxOfLanes(f, deepest));
  out.iterations = std::max(1u, state.rounds);
  return true;
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
HWY_INLINE bool resolve_sharp(const Baked& baked, const ReliefTables* relief,
                              const ResponseParameters& parameters, const ParticleBatch& batch,
                              BatchResponse& out) {
  float shortest_m = 0.0f;
  // This is skipped with a candidate cache and without safe positions: the cache detects empty batches, and
  // no limit on paths is needed.
  if (!batch.cache.batch || batch.has_safe) {
    const Aabb e = aabb_of(batch);
    const float bulge_m = relief ? relief->highest_m + relief->blend_m : 0.0f;
    const float travel_m = batch.has_safe ? parameters.travel_m : 0.0f;
    shortest_m = shortest_radius(
        baked, e, parameters.clearance_m + bulge_m + travel_m + baked.rounding_m + rounding_over(e));
    if (shortest_m >= 1e30f) {
      note_radii(batch, out);
      return true;
    }
  }
  Scratch scratch;
  const Surface surface{baked, relief, parameters, nullptr, scratch};
  return resolve_on(surface, kShortPath * shortest_m, 1e30f, batch, out);
}

/// Resolves the batch against the smooth union of the ellipsoids.
HWY_INLINE bool resolve_filleted(const Baked& baked, const ResponseParameters& parameters,
                                 const ParticleBatch& batch, BatchResponse& out) {
  note_radii(batch, out);
  const Aabb e = aabb_of(batch);
  const float travel_m = batch.has_safe ? parameters.travel_m : 0.0f;
  const float window_m = parameters.clearance_m + 2.0f * parameters.blend_m + travel_m;
  const float shortest_m = shortest_radius(baked, e, window_m + baked.rounding_m + rounding_over(e));
  if (shortest_m >= 1e30f) return true;
  TangentCandidates candidates;
  if (!cull_for_response(baked, batch, window_m, candidates)) return false;
  if (candidates.count == 0) return true;
  Scratch scratch;
  const Surface surface{baked, nullptr, parameters, &candidates, scratch};
  return resolve_on(surface, kShortPath * shortest_m, candidates.reach_m, batch, out);
}

/// Resolves the batch, with fillets if they are requested and there is no relief.
HWY_INLINE bool resolve_lanes(const Baked& baked, const ReliefTables* relief,
                              const ResponseParameters& parameters, const ParticleBatch& batch,
                              BatchResponse& out) {
  if (!relief && parameters.blend_m > 0.0f) return resolve_filleted(baked, parameters, batch, out);
  return resolve_sharp(baked, relief, parameters, batch, out);
}

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
