// Signed distance, nearest point, normal and owner for a batch.
#if defined(BODICE_COLLISION_QUERY_INL_) == defined(HWY_TARGET_TOGGLE)
#ifdef BODICE_COLLISION_QUERY_INL_
#undef BODICE_COLLISION_QUERY_INL_
#else
#define BODICE_COLLISION_QUERY_INL_
#endif

#include <cstring>

#include "simd/nearest-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::collision::HWY_NAMESPACE {

static_assert(sizeof(Contact) == 32);

/// From arrays to records: transposed in registers, stored by halves.
HWY_INLINE void write(const Batched& found, const QueryBatch& batch) {
  constexpr std::size_t kHalf = sizeof(Contact) / 2;
  alignas(64) float low[4 * kWidth], high[4 * kWidth];
  const V margin = all(batch.margin_m);
  for (int i = 0; i < batch.count; i += kWidth) {
    const V d = hn::Sub(hn::Load(f, found.distance + i), margin);
    const V3 n = load3(found.gx + i, found.gy + i, found.gz + i);
    const V3 point = along(load3(batch.x + i, batch.y + i, batch.z + i), hn::Neg(d), n);
    hn::StoreInterleaved4(d, point.x, point.y, point.z, f, low);
    hn::StoreInterleaved4(n.x, n.y, n.z, hn::BitCast(f, hn::Load(I(), found.name + i)), f, high);
    const int count = std::min(kWidth, batch.count - i);
    for (int lane = 0; lane < count; ++lane) {
      char* to = reinterpret_cast<char*>(batch.contacts + batch.index[i + lane]);
      std::memcpy(to, low + 4 * lane, kHalf);
      std::memcpy(to + kHalf, high + 4 * lane, kHalf);
    }
  }
}

HWY_INLINE bool query_batch_lanes(const Baked& baked, const ReliefTables* relief, QueryBatch& batch) {
  Batched found;
  if (!nearest(baked, relief, batch, found)) return false;
  write(found, batch);
  return true;
}

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
