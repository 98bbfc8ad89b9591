// Pairs of a particle and an ellipsoid, evaluated exactly, a whole vector of them at a time.
#if defined(BODICE_COLLISION_PAIRS_INL_) == defined(HWY_TARGET_TOGGLE)
#ifdef BODICE_COLLISION_PAIRS_INL_
#undef BODICE_COLLISION_PAIRS_INL_
#else
#define BODICE_COLLISION_PAIRS_INL_
#endif

#include <cstdint>

#include "model/batch.hpp"
#include "simd/ellipsoid/columns-inl.hpp"
#include "simd/ellipsoid/relief_table-inl.hpp"
#include "simd/math/pack-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::collision::HWY_NAMESPACE {

/// The distances of kSize particles to one ellipsoid each, as arrays.
template <int kSize>
struct alignas(64) ResultRows {
  float distance[kSize];  ///< to the ellipsoid, meters
  float value[kSize];     ///< relief only: corrected distance, meters
  float gx[kSize], gy[kSize],
      gz[kSize];                    ///< gradient of the value; the unit normal without relief
  std::int32_t proxy_index[kSize];  ///< index of the ellipsoid in the proxy
};

/// The distances of one vector of particles, each to the ellipsoid of its column.
struct Result {
  V distance, value;
  V3 gradient;
  VI proxy_index;
};

/// Evaluates several vectors side by side.
template <int kTables, int kCount>
HWY_INLINE void evaluate_each(const ReliefTables* relief, const Columns& columns, const VI (&column)[kCount],
                              const V3 (&p)[kCount], Result (&out)[kCount]) {
  Shape shape[kCount];
  ClosestPointLanes closest[kCount];
  for (int i = 0; i < kCount; ++i) shape[i] = shape_of<kTables>(columns, column[i]);
  closest_points(shape, p, closest);
  for (int i = 0; i < kCount; ++i) {
    const VI proxy_index = proxy_indices_of<kTables>(columns, column[i]);
    if (relief) {
      const TableLanes table = table_of<kTables>(columns, column[i]);
      const Corrected one = corrected(*relief, table, shape[i], closest[i],
                                      [&] { return axes_of<kTables>(columns, column[i]); });
      out[i] = {closest[i].distance, one.value, one.gradient, proxy_index};
    } else {
      out[i] = {closest[i].distance, closest[i].distance, normal_of(shape[i], closest[i]), proxy_index};
    }
  }
}

template <int kSize>
HWY_INLINE void put(const Result& a, bool relief, ResultRows<kSize>& to, int i) {
  hn::Store(a.distance, f, to.distance + i);
  if (relief) hn::Store(a.value, f, to.value + i);
  store3(a.gradient, to.gx + i, to.gy + i, to.gz + i);
  hn::Store(a.proxy_index, I(), to.proxy_index + i);
}

/// Pairs of blocks that share columns.
struct Pairs {
  static constexpr int kCapacity = 1024;
  static constexpr int kSize = kCapacity + 32;
  alignas(64) std::int32_t lane[kSize];
  alignas(64) std::int32_t column[kSize];
  ResultRows<kSize> results;
  int count = 0;

  bool fit(int vectors) const { return count + vectors * kWidth <= kCapacity; }
  /// Adds the lanes of `mask`, each with its column.
  HWY_INLINE void add(M mask, VI lanes, VI columns) {
    const Pack pack(mask);
    pack.store(lanes, lane + count);
    pack.store(columns, column + count);
    count += pack.count();
  }
};

template <int kTables>
HWY_INLINE void evaluate_pairs(const ReliefTables* relief, const Columns& columns, const QueryBatch& batch,
                               Pairs& pairs) {
  if (pairs.count == 0) return;
  // The last vectors are filled up with valid pairs.
  for (int v = 0; v < kVectorsInStep; ++v) {
    hn::StoreU(hn::Set(I(), pairs.lane[0]), I(), pairs.lane + pairs.count + v * kWidth);
    hn::StoreU(hn::Zero(I()), I(), pairs.column + pairs.count + v * kWidth);
  }
  for (int from = 0; from < pairs.count; from += kVectorsInStep * kWidth) {
    VI column[kVectorsInStep];
    V3 p[kVectorsInStep];
    Result results[kVectorsInStep];
    for (int v = 0; v < kVectorsInStep; ++v) {
      const VI lane = hn::Load(I(), pairs.lane + from + v * kWidth);
      column[v] = hn::Load(I(), pairs.column + from + v * kWidth);
      p[v] = {hn::GatherIndex(f, batch.x, lane), hn::GatherIndex(f, batch.y, lane),
              hn::GatherIndex(f, batch.z, lane)};
    }
    evaluate_each<kTables>(relief, columns, column, p, results);
    for (int v = 0; v < kVectorsInStep; ++v)
      put(results[v], relief != nullptr, pairs.results, from + v * kWidth);
  }
}

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
