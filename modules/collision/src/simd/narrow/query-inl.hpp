// Queries of a batch: signed distance, closest point, normal and owner.
#if defined(BODICE_COLLISION_QUERY_INL_) == defined(HWY_TARGET_TOGGLE)
#ifdef BODICE_COLLISION_QUERY_INL_
#undef BODICE_COLLISION_QUERY_INL_
#else
#define BODICE_COLLISION_QUERY_INL_
#endif

#include <bit>

#include "simd/narrow/contacts-inl.hpp"
#include "simd/narrow/in_range-inl.hpp"
#include "simd/narrow/nearest-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::inline v0_1::collision::HWY_NAMESPACE {

/// A vector of results as contacts.
HWY_INLINE ContactLanes contacts_at(const BatchResults& found, int i, V3 p, V margin) {
  const V d = hn::Sub(hn::Load(f, found.distance + i), margin);
  const V3 n = load3(found.gx + i, found.gy + i, found.gz + i);
  return {d, add_scaled(p, hn::Neg(d), n), n, hn::Load(I(), found.proxy_index + i)};
}

/// Writes the contacts of all lanes.
HWY_INLINE void write_results(const BatchResults& found, const Positions& at, const ContactOutput& out) {
  const V margin = all(out.margin_m);
  for (int i = 0; i < at.count; i += kWidth) {
    const V3 p = {hn::LoadU(f, at.x + i), hn::LoadU(f, at.y + i), hn::LoadU(f, at.z + i)};
    write_contacts(contacts_at(found, i, p, margin), out, i, at.count);
  }
}

/// Replaces contacts beyond the contact distance by no_contact().
HWY_INLINE void drop_beyond(const ContactOutput& out, int count) {
  for (int lane = 0; lane < count; ++lane) {
    Contact& contact = out.of(lane);
    if (!(contact.signed_distance <= out.within_m)) contact = no_contact();
  }
}

/// Writes the contacts of the particles in `in_range`.
HWY_INLINE void write_in_range(const InRange& in_range, const BatchResults& found, const ContactOutput& out) {
  const V margin = all(out.margin_m);
  for (int i = 0; i < in_range.count; i += kWidth) {
    const V3 p = load3(in_range.x + i, in_range.y + i, in_range.z + i);
    ContactLanes c = contacts_at(found, i, p, margin);
    hide_beyond(out.within_m, c);
    const M real = hn::RebindMask(f, hn::Gt(hn::Load(I(), in_range.lane + i), hn::Set(I(), -1)));
    const auto to = [&](int k) -> Contact& { return out.of(in_range.lane[i + k]); };
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
HWY_INLINE void write_none_except(const InRange& in_range, const ContactOutput& out, int count) {
  const Contact none = no_contact();
  for (int begin = 0; begin < count; begin += kBlock)
    for (std::uint64_t left = ~in_range.which.from(begin); left != 0; left &= left - 1) {
      const int lane = begin + std::countr_zero(left);
      if (lane >= count) break;
      out.of(lane) = none;
    }
}

/// Query with a contact distance; where the lists overflow all distances are found and then filtered.
template <class Union>
HWY_INLINE Status query_within(const Union& proxy, Batch& batch, const ContactOutput& out) {
  BatchResults found;
  Kernel<Union> kernel(proxy);
  InRange in_range;
  const float limit_m = out.within_m + out.margin_m;
  if (limit_m < kFarthest_m && nearest_in_range(kernel, batch, limit_m, in_range, found) == Status::kDone) {
    write_none_except(in_range, out, batch.at.count);
    write_in_range(in_range, found, out);
    return Status::kDone;
  }
  const Status status = nearest(kernel, batch, found);
  if (status != Status::kDone) return status;
  write_results(found, batch.at, out);
  drop_beyond(out, batch.at.count);
  return status;
}

/// Query of all distances.
template <class Union>
HWY_INLINE Status query_all(const Union& proxy, Batch& batch, const ContactOutput& out) {
  BatchResults found;
  Kernel<Union> kernel(proxy);
  const Status status = nearest(kernel, batch, found);
  if (status == Status::kDone) write_results(found, batch.at, out);
  return status;
}

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
