// Queries of a batch: signed distance, closest point, normal and owner.
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

/// Writes the contacts of all lanes.
HWY_INLINE void write_results(const BatchResults& found, const QueryBatch& batch) {
  const V margin = all(batch.margin_m);
  for (int i = 0; i < batch.count; i += kWidth) {
    const V d = hn::Sub(hn::Load(f, found.distance + i), margin);
    const V3 n = load3(found.gx + i, found.gy + i, found.gz + i);
    const V3 p = {hn::LoadU(f, batch.x + i), hn::LoadU(f, batch.y + i), hn::LoadU(f, batch.z + i)};
    write_contacts({d, add_scaled(p, hn::Neg(d), n), n, hn::Load(I(), found.proxy_index + i)}, batch, i,
                   batch.count);
  }
}

/// Replaces contacts beyond the contact distance by no_contact().
HWY_INLINE void drop_beyond(const QueryBatch& batch) {
  for (int lane = 0; lane < batch.count; ++lane) {
    Contact& contact = contact_of(batch, lane);
    if (!(contact.signed_distance <= batch.within_m)) contact = no_contact();
  }
}

/// Writes the contacts of the particles in `in_range`.
HWY_INLINE void write_in_range(const InRange& in_range, const BatchResults& found, const QueryBatch& batch) {
  const V margin = all(batch.margin_m);
  for (int i = 0; i < in_range.count; i += kWidth) {
    const V d = hn::Sub(hn::Load(f, found.distance + i), margin);
    const V3 n = load3(found.gx + i, found.gy + i, found.gz + i);
    const V3 p = load3(in_range.x + i, in_range.y + i, in_range.z + i);
    ContactLanes c = {d, add_scaled(p, hn::Neg(d), n), n, hn::Load(I(), found.proxy_index + i)};
    hide_beyond(batch.within_m, c);
    const M real = hn::RebindMask(f, hn::Gt(hn::Load(I(), in_range.lane + i), hn::Set(I(), -1)));
    const auto to = [&](int k) -> Contact& { return contact_of(batch, in_range.lane[i + k]); };
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

/// Writes no_contact() for the lanes that are not in `in_range`.
HWY_INLINE void write_none_except(const InRange& in_range, const QueryBatch& batch) {
  const Contact none = no_contact();
  for (int begin = 0; begin < batch.count; begin += kBlock)
    for (std::uint64_t left = ~in_range.which.from(begin); left != 0; left &= left - 1) {
      const int lane = begin + std::countr_zero(left);
      if (lane >= batch.count) break;
      contact_of(batch, lane) = none;
    }
}

/// Query with a contact distance; on overflow all distances are found and then filtered.
HWY_INLINE bool query_within_lanes(const Baked& baked, const ReliefTables* relief, QueryBatch& batch) {
  BatchResults found;
  Scratch scratch;
  InRange in_range;
  const float limit_m = batch.within_m + batch.margin_m;
  if (limit_m < kFarthest_m && nearest_in_range(baked, relief, batch, limit_m, scratch, in_range, found)) {
    write_none_except(in_range, batch);
    write_in_range(in_range, found, batch);
    return true;
  }
  if (!nearest(baked, relief, batch, scratch, found)) return false;
  write_results(found, batch);
  drop_beyond(batch);
  return true;
}

/// Query of all distances.
HWY_INLINE bool query_batch_lanes(const Baked& baked, const ReliefTables* relief, QueryBatch& batch) {
  BatchResults found;
  Scratch scratch;
  if (!nearest(baked, relief, batch, scratch, found)) return false;
  write_results(found, batch);
  return true;
}

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
