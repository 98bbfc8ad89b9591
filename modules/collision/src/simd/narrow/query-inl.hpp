// Signed distance, closest point, normal and owner for a batch.
#if defined(BODICE_COLLISION_QUERY_INL_) == defined(HWY_TARGET_TOGGLE)
#ifdef BODICE_COLLISION_QUERY_INL_
#undef BODICE_COLLISION_QUERY_INL_
#else
#define BODICE_COLLISION_QUERY_INL_
#endif

#include "simd/narrow/contacts-inl.hpp"
#include "simd/narrow/in_range-inl.hpp"

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
  const V margin = all(batch.margin_m);
  for (int i = 0; i < reached.count; i += kWidth) {
    const V d = hn::Sub(hn::Load(f, found.distance + i), margin);
    const V3 n = load3(found.gx + i, found.gy + i, found.gz + i);
    const V3 p = load3(reached.x + i, reached.y + i, reached.z + i);
    ContactLanes c = {d, along(p, hn::Neg(d), n), n, hn::Load(I(), found.name + i)};
    hide_beyond(batch.within_m, c);
    const M real = hn::RebindMask(f, hn::Gt(hn::Load(I(), reached.lane + i), hn::Set(I(), -1)));
    const auto to = [&](int k) -> Contact& { return contact_of(batch, reached.lane[i + k]); };
    if (hn::AllTrue(f, real)) {
      store_contacts(c, [&](int k) { return &to(k); });
      continue;
    }
    alignas(64) Contact contacts[kWidth];
    store_contacts(c, [&](int k) { return contacts + k; });
    for (std::uint64_t left = bits(real); left != 0; left &= left - 1) {
      const int k = std::countr_zero(left);
      to(k) = contacts[k];
    }
  }
}

/// For the lanes that were not reached.
HWY_INLINE void write_none_but(const Reached& reached, const QueryBatch& batch) {
  const Contact none = no_contact();
  for (int begin = 0; begin < batch.count; begin += kBlock)
    for (std::uint64_t left = ~reached.which.from(begin); left != 0; left &= left - 1) {
      const int lane = begin + std::countr_zero(left);
      if (lane >= batch.count) break;
      contact_of(batch, lane) = none;
    }
}

HWY_INLINE bool query_within_lanes(const Baked& baked, const ReliefTables* relief, QueryBatch& batch) {
  Batched found;
  Scratch scratch;
  Reached reached;
  const float limit_m = batch.within_m + batch.margin_m;
  if (limit_m < kFarthest && nearest_within(baked, relief, batch, limit_m, scratch, reached, found)) {
    write_none_but(reached, batch);
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
