// Signed distance, nearest point, normal and owner for a batch.
#if defined(BODICE_COLLISION_QUERY_INL_) == defined(HWY_TARGET_TOGGLE)
#ifdef BODICE_COLLISION_QUERY_INL_
#undef BODICE_COLLISION_QUERY_INL_
#else
#define BODICE_COLLISION_QUERY_INL_
#endif

#include "simd/contacts-inl.hpp"
#include "simd/within-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::collision::HWY_NAMESPACE {

HWY_INLINE void write(const Batched& found, const QueryBatch& batch) {
  const V margin = all(batch.margin_m);
  for (int i = 0; i < batch.count; i += kWidth) {
    const V d = hn::Sub(hn::Load(f, found.distance + i), margin);
    const V3 n = load3(found.gx + i, found.gy + i, found.gz + i);
    const V3 p = {hn::LoadU(f, batch.x + i), hn::LoadU(f, batch.y + i), hn::LoadU(f, batch.z + i)};
    write_contacts({d, along(p, hn::Neg(d), n), n, hn::Load(I(), found.name + i)}, batch, i, batch.count);
  }
}

/// Takes back what is farther than was asked for.
HWY_INLINE void keep_within(const QueryBatch& batch) {
  for (int lane = 0; lane < batch.count; ++lane) {
    Contact& contact = contact_of(batch, lane);
    if (!(contact.signed_distance <= batch.within_m)) contact = no_contact();
  }
}

HWY_INLINE void write_reached(const Reached& reached, const Batched& found, const QueryBatch& batch) {
  write_none(batch, 0, batch.count);
  const V margin = all(batch.margin_m), within = all(batch.within_m);
  for (int i = 0; i < reached.count; i += kWidth) {
    const V d = hn::Sub(hn::Load(f, found.distance + i), margin);
    const VI lanes = hn::Load(I(), reached.lane + i);
    const M told = hn::And(hn::Le(d, within), hn::RebindMask(f, hn::Gt(lanes, hn::Set(I(), -1))));
    if (hn::AllFalse(f, told)) continue;
    const V3 n = load3(found.gx + i, found.gy + i, found.gz + i);
    const V3 point = along(load3(reached.x + i, reached.y + i, reached.z + i), hn::Neg(d), n);
    alignas(64) Contact contacts[kWidth];
    store_contacts({d, point, n, hn::Load(I(), found.name + i)}, [&](int lane) { return contacts + lane; });
    for (std::uint64_t left = bits(told); left != 0; left &= left - 1) {
      const int k = std::countr_zero(left);
      contact_of(batch, reached.lane[i + k]) = contacts[k];
    }
  }
}

HWY_INLINE bool query_within_lanes(const Baked& baked, const ReliefTables* relief, QueryBatch& batch) {
  Batched found;
  Scratch scratch;
  Reached reached;
  const float limit_m = batch.within_m + batch.margin_m;
  if (limit_m < kFarthest && nearest_within(baked, relief, batch, limit_m, scratch, reached, found)) {
    write_reached(reached, found, batch);
    return true;
  }
  if (!nearest(baked, relief, batch, scratch, found)) return false;
  write(found, batch);
  keep_within(batch);
  return true;
}

HWY_INLINE bool query_batch_lanes(const Baked& baked, const ReliefTables* relief, QueryBatch& batch) {
  Batched found;
  Scratch scratch;
  if (!nearest(baked, relief, batch, scratch, found)) return false;
  write(found, batch);
  return true;
}

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
