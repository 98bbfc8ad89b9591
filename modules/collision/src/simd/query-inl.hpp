// Signed distance, nearest point, normal and owner for a batch.
#if defined(BODICE_COLLISION_QUERY_INL_) == defined(HWY_TARGET_TOGGLE)
#ifdef BODICE_COLLISION_QUERY_INL_
#undef BODICE_COLLISION_QUERY_INL_
#else
#define BODICE_COLLISION_QUERY_INL_
#endif

#include "simd/within-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::collision::HWY_NAMESPACE {

static_assert(sizeof(Contact) == 8 * sizeof(float));

#if HWY_TARGET != HWY_SCALAR
/// Rows of four numbers out of four columns: row k of each block of four particles.
HWY_INLINE void rows_of_four(V a, V b, V c, V d, V (&row)[4]) {
  const V ac = hn::InterleaveLower(f, a, c), bd = hn::InterleaveLower(f, b, d);
  const V ac2 = hn::InterleaveUpper(f, a, c), bd2 = hn::InterleaveUpper(f, b, d);
  row[0] = hn::InterleaveLower(f, ac, bd);
  row[1] = hn::InterleaveUpper(f, ac, bd);
  row[2] = hn::InterleaveLower(f, ac2, bd2);
  row[3] = hn::InterleaveUpper(f, ac2, bd2);
}
#endif

/// Stores one vector of contacts, the first of which goes to `to(0)`: transposed in registers, a contact or
/// half of one a store.
template <class To>
HWY_INLINE void store_contacts(V d, V3 point, V3 normal, V name, To&& to) {
#if HWY_TARGET == HWY_SCALAR
  const V values[8] = {d, point.x, point.y, point.z, normal.x, normal.y, normal.z, name};
  for (int i = 0; i < 8; ++i) to(0)[i] = hn::GetLane(values[i]);
#else
  V first[4], second[4];
  rows_of_four(d, point.x, point.y, point.z, first);
  rows_of_four(normal.x, normal.y, normal.z, name, second);
  for (int k = 0; k < 4; ++k) {
    if constexpr (kWidth == 4) {
      hn::StoreU(first[k], f, to(k));
      hn::StoreU(second[k], f, to(k) + 4);
    } else {
      const V even = hn::OddEvenBlocks(hn::SwapAdjacentBlocks(second[k]), first[k]);
      const V odd = hn::OddEvenBlocks(second[k], hn::SwapAdjacentBlocks(first[k]));
      if constexpr (kWidth == 8) {
        hn::StoreU(even, f, to(k));
        hn::StoreU(odd, f, to(4 + k));
      } else {
        const hn::Half<F> half;
        hn::StoreU(hn::LowerHalf(half, even), half, to(k));
        hn::StoreU(hn::LowerHalf(half, odd), half, to(4 + k));
        hn::StoreU(hn::UpperHalf(half, even), half, to(8 + k));
        hn::StoreU(hn::UpperHalf(half, odd), half, to(12 + k));
      }
    }
  }
#endif
}

HWY_INLINE void write(const Batched& found, const QueryBatch& batch) {
  const V margin = all(batch.margin_m);
  for (int i = 0; i < batch.count; i += kWidth) {
    const V d = hn::Sub(hn::Load(f, found.distance + i), margin);
    const V3 n = load3(found.gx + i, found.gy + i, found.gz + i);
    const V3 p = {hn::LoadU(f, batch.x + i), hn::LoadU(f, batch.y + i), hn::LoadU(f, batch.z + i)};
    const V3 point = along(p, hn::Neg(d), n);
    const V name = hn::BitCast(f, hn::Load(I(), found.name + i));
    const auto into = [&](Contact* contact) { return &contact->signed_distance; };
    if (batch.count - i < kWidth) {
      alignas(64) Contact last[kWidth];
      store_contacts(d, point, n, name, [&](int lane) { return into(last + lane); });
      for (int lane = i; lane < batch.count; ++lane)
        batch.contacts[batch.index ? batch.index[lane] : static_cast<std::uint32_t>(lane)] = last[lane - i];
    } else if (batch.index) {
      store_contacts(d, point, n, name,
                     [&](int lane) { return into(batch.contacts + batch.index[i + lane]); });
    } else {
      store_contacts(d, point, n, name, [&](int lane) { return into(batch.contacts + i + lane); });
    }
  }
}

HWY_INLINE Contact& contact_of(const QueryBatch& batch, int lane) {
  return batch.contacts[batch.index ? batch.index[lane] : static_cast<std::uint32_t>(lane)];
}

/// Takes back what is farther than was asked for.
HWY_INLINE void keep_within(const QueryBatch& batch) {
  for (int lane = 0; lane < batch.count; ++lane) {
    Contact& contact = contact_of(batch, lane);
    if (!(contact.signed_distance <= batch.within_m)) contact = no_contact();
  }
}

HWY_INLINE void write_reached(const Reached& reached, const Batched& found, const QueryBatch& batch) {
  const Contact none = no_contact();
  for (int lane = 0; lane < batch.count; ++lane) contact_of(batch, lane) = none;
  const V margin = all(batch.margin_m), within = all(batch.within_m);
  for (int i = 0; i < reached.count; i += kWidth) {
    const V d = hn::Sub(hn::Load(f, found.distance + i), margin);
    const VI lanes = hn::Load(I(), reached.lane + i);
    const M told = hn::And(hn::Le(d, within), hn::RebindMask(f, hn::Gt(lanes, hn::Set(I(), -1))));
    if (hn::AllFalse(f, told)) continue;
    const V3 n = load3(found.gx + i, found.gy + i, found.gz + i);
    const V3 point = along(load3(reached.x + i, reached.y + i, reached.z + i), hn::Neg(d), n);
    const V name = hn::BitCast(f, hn::Load(I(), found.name + i));
    alignas(64) Contact contacts[kWidth];
    store_contacts(d, point, n, name, [&](int lane) { return &contacts[lane].signed_distance; });
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
