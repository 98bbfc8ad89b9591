// Stores the chosen lanes of a vector next to each other. Targets without an instruction for that permute by
// a table. Highway 1.0 has that table, too, but g++ copies its kilobyte onto the stack at each use, which
// took a third of a query's time.
#if defined(BODICE_COLLISION_PACK_INL_) == defined(HWY_TARGET_TOGGLE)
#ifdef BODICE_COLLISION_PACK_INL_
#undef BODICE_COLLISION_PACK_INL_
#else
#define BODICE_COLLISION_PACK_INL_
#endif

#include <bit>
#include <cstdint>

#include "simd/math/pack_table.hpp"
#include "simd/math/vec3-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::inline v0_1::collision::HWY_NAMESPACE {

/// The chosen lanes of a mask. Stores write whole vectors: what lies beyond the count must be overwritten or
/// left unread.
class Pack {
 public:
  HWY_INLINE int count() const { return count_; }

#if HWY_TARGET == HWY_SCALAR || HWY_TARGET == HWY_AVX3
  explicit HWY_INLINE Pack(M which) : which_(which), count_(static_cast<int>(hn::CountTrue(f, which))) {}
  HWY_INLINE void store(V values, float* to) const {
    hn::StoreU(hn::Compress(values, which_), f, to);
  }
  HWY_INLINE void store(VI values, std::int32_t* to) const {
    hn::StoreU(hn::Compress(values, hn::RebindMask(I(), which_)), I(), to);
  }

 private:
  M which_;
#else
  explicit HWY_INLINE Pack(M which) : Pack(bits(which)) {}
  HWY_INLINE void store(V values, float* to) const {
    hn::StoreU(lookup_lanes(values, from_), f, to);
  }
  HWY_INLINE void store(VI values, std::int32_t* to) const {
    store(hn::BitCast(f, values), reinterpret_cast<float*>(to));
  }

 private:
  static_assert(kWidth <= kPackLanes);
  static constexpr hn::Rebind<std::uint8_t, F> kBytes{};

  explicit HWY_INLINE Pack(std::uint64_t which)
      : from_(lane_indices(hn::PromoteTo(I(), hn::LoadU(kBytes, kPackTable.from[which])))),
        count_(std::popcount(which)) {}

  LaneIndices from_;
#endif
  int count_;
};

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
