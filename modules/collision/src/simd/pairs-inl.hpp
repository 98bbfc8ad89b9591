// Pairs of a particle and an ellipsoid, each evaluated exactly, a whole vector of them at a time.
#if defined(BODICE_COLLISION_PAIRS_INL_) == defined(HWY_TARGET_TOGGLE)
#ifdef BODICE_COLLISION_PAIRS_INL_
#undef BODICE_COLLISION_PAIRS_INL_
#else
#define BODICE_COLLISION_PAIRS_INL_
#endif

#include <cstdint>

#include "kernels.hpp"
#include "simd/lookup-inl.hpp"
#include "simd/table-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::collision::HWY_NAMESPACE {

/// What one ellipsoid says about each of kSize particles.
template <int kSize>
struct alignas(64) Answers {
  float distance[kSize];                  ///< to the ellipsoid, metres
  float value[kSize];                     ///< relief only: the corrected distance, metres
  float gx[kSize], gy[kSize], gz[kSize];  ///< its gradient: the unit normal without relief
  std::int32_t name[kSize];               ///< the proxy's index of the ellipsoid
};

/// The answers to one vector of particles, each about the ellipsoid of its column.
struct Answer {
  V distance, value;
  V3 gradient;
  VI name;
};

template <int kTables>
HWY_INLINE Answer answer(const ReliefTables* relief, const Columns& columns, VI column, V3 p) {
  const Shape shape = shape_of<kTables>(columns, column);
  const Foot foot = foot_of(shape, p);
  const VI name = names_of<kTables>(columns, column);
  if (!relief) return {foot.distance, foot.distance, foot.normal, name};
  const Corrected one = corrected(*relief, table_of<kTables>(columns, column), shape, foot);
  return {foot.distance, one.value, one.gradient, name};
}

template <int kSize>
HWY_INLINE void put(const Answer& a, bool relief, Answers<kSize>& to, int i) {
  hn::Store(a.distance, f, to.distance + i);
  if (relief) hn::Store(a.value, f, to.value + i);
  store3(a.gradient, to.gx + i, to.gy + i, to.gz + i);
  hn::Store(a.name, I(), to.name + i);
}

template <int kSize>
HWY_INLINE void put_where(M mask, const Answer& a, Answers<kSize>& to, int i) {
  hn::BlendedStore(a.distance, mask, f, to.distance + i);
  hn::BlendedStore(a.value, mask, f, to.value + i);
  hn::BlendedStore(a.gradient.x, mask, f, to.gx + i);
  hn::BlendedStore(a.gradient.y, mask, f, to.gy + i);
  hn::BlendedStore(a.gradient.z, mask, f, to.gz + i);
  hn::BlendedStore(a.name, hn::RebindMask(I(), mask), I(), to.name + i);
}

struct Pairs {
  static constexpr int kCapacity = 1024;
  static constexpr int kSize = kCapacity + 16;
  alignas(64) std::int32_t lane[kSize];
  alignas(64) std::int32_t column[kSize];
  Answers<kSize> answers;
  int count = 0, answered = 0;
  Columns columns;

  /// Room for one more vector of lanes about one more ellipsoid, once those before are answered.
  bool fits() const { return count + kWidth <= kCapacity; }
};

/// Answers the pairs that are not yet, and empties the table of columns.
inline HWY_NOINLINE void answer_pairs(const ReliefTables* relief, const QueryBatch& batch, Pairs& pairs) {
  if (pairs.answered < pairs.count) {
    // What a last vector holds beyond the count must be a valid pair, too.
    hn::StoreU(hn::Zero(I()), I(), pairs.lane + pairs.count);
    hn::StoreU(hn::Zero(I()), I(), pairs.column + pairs.count);
    with_tables(pairs.columns, [&](auto tables) {
      for (int i = pairs.answered; i < pairs.count; i += kWidth) {
        const VI lane = hn::LoadU(I(), pairs.lane + i);
        const V3 p = {hn::GatherIndex(f, batch.x, lane), hn::GatherIndex(f, batch.y, lane),
                      hn::GatherIndex(f, batch.z, lane)};
        const Answer a = answer<tables()>(relief, pairs.columns, hn::LoadU(I(), pairs.column + i), p);
        Answers<Pairs::kSize>& to = pairs.answers;
        hn::StoreU(a.distance, f, to.distance + i);
        hn::StoreU(a.value, f, to.value + i);
        hn::StoreU(a.gradient.x, f, to.gx + i);
        hn::StoreU(a.gradient.y, f, to.gy + i);
        hn::StoreU(a.gradient.z, f, to.gz + i);
        hn::StoreU(a.name, I(), to.name + i);
      }
    });
  }
  pairs.answered = pairs.count;
  pairs.columns.count = 0;
}

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
