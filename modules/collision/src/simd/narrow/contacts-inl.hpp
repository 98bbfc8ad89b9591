// Writes the results of lanes to the caller's contacts.
#if defined(BODICE_COLLISION_CONTACTS_INL_) == defined(HWY_TARGET_TOGGLE)
#ifdef BODICE_COLLISION_CONTACTS_INL_
#undef BODICE_COLLISION_CONTACTS_INL_
#else
#define BODICE_COLLISION_CONTACTS_INL_
#endif

#include <algorithm>

#include "model/batch.hpp"
#include "simd/math/vec3-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::inline v0_1::collision::HWY_NAMESPACE {

static_assert(sizeof(Contact) == 8 * sizeof(float));

#if HWY_TARGET != HWY_SCALAR
/// Transposes four columns: row k has the four numbers of particle k of each block of four lanes.
HWY_INLINE void rows_of_four(V a, V b, V c, V d, V (&row)[4]) {
  const V ac = hn::InterleaveLower(f, a, c), bd = hn::InterleaveLower(f, b, d);
  const V ac2 = hn::InterleaveUpper(f, a, c), bd2 = hn::InterleaveUpper(f, b, d);
  row[0] = hn::InterleaveLower(f, ac, bd);
  row[1] = hn::InterleaveUpper(f, ac, bd);
  row[2] = hn::InterleaveLower(f, ac2, bd2);
  row[3] = hn::InterleaveUpper(f, ac2, bd2);
}
#endif

/// The contacts of one vector of particles.
struct ContactLanes {
  V distance;
  V3 point, normal;
  VI proxy_index;
};

/// Stores the contacts, lane k where `to(k)` points. They are transposed in registers; each store writes a
/// contact or half of one.
template <class To>
HWY_INLINE void store_contacts(const ContactLanes& c, To&& to) {
  const auto floats = [&](int lane) { return &to(lane)->signed_distance; };
  const V proxy_index = hn::BitCast(f, c.proxy_index);
#if HWY_TARGET == HWY_SCALAR
  const V values[8] = {c.distance, c.point.x,  c.point.y,  c.point.z,
                       c.normal.x, c.normal.y, c.normal.z, proxy_index};
  for (int i = 0; i < 8; ++i) floats(0)[i] = hn::GetLane(values[i]);
#else
  V first[4], second[4];
  rows_of_four(c.distance, c.point.x, c.point.y, c.point.z, first);
  rows_of_four(c.normal.x, c.normal.y, c.normal.z, proxy_index, second);
  for (int k = 0; k < 4; ++k) {
    if constexpr (kWidth == 4) {
      hn::StoreU(first[k], f, floats(k));
      hn::StoreU(second[k], f, floats(k) + 4);
    } else {
      const V even = hn::OddEvenBlocks(hn::SwapAdjacentBlocks(second[k]), first[k]);
      const V odd = hn::OddEvenBlocks(second[k], hn::SwapAdjacentBlocks(first[k]));
      if constexpr (kWidth == 8) {
        hn::StoreU(even, f, floats(k));
        hn::StoreU(odd, f, floats(4 + k));
      } else {
        const hn::Half<F> half;
        hn::StoreU(hn::LowerHalf(half, even), half, floats(k));
        hn::StoreU(hn::LowerHalf(half, odd), half, floats(4 + k));
        hn::StoreU(hn::UpperHalf(half, even), half, floats(8 + k));
        hn::StoreU(hn::UpperHalf(half, odd), half, floats(12 + k));
      }
    }
  }
#endif
}

/// Replaces contacts beyond the contact distance by no_contact().
HWY_INLINE void hide_beyond(float within_m, ContactLanes& c) {
  const Contact none = no_contact();
  const M within = hn::Le(c.distance, all(within_m));
  c.distance = hn::IfThenElse(within, c.distance, all(none.signed_distance));
  c.point = select(within, c.point, broadcast3(none.point));
  c.normal = select(within, c.normal, broadcast3(none.normal));
  c.proxy_index = hn::IfThenElse(hn::RebindMask(I(), within), c.proxy_index,
                                 hn::Set(I(), static_cast<std::int32_t>(none.ellipsoid)));
}

/// Writes the contacts of the lanes [i, i + kWidth) that are below the end.
HWY_INLINE void write_contacts(const ContactLanes& c, const ContactOutput& out, int i, int end) {
  if (end - i < kWidth) {
    alignas(64) Contact last[kWidth];
    store_contacts(c, [&](int lane) { return last + lane; });
    for (int lane = i; lane < end; ++lane) out.of(lane) = last[lane - i];
  } else if (out.index) {
    store_contacts(c, [&](int lane) { return out.contacts + out.index[i + lane]; });
  } else {
    store_contacts(c, [&](int lane) { return out.contacts + i + lane; });
  }
}

/// Writes no_contact() for the lanes [begin, end).
HWY_INLINE void write_none(const ContactOutput& out, int begin, int end) {
  const Contact none = no_contact();
  for (int lane = begin; lane < end; ++lane) out.of(lane) = none;
}

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
