// A different ellipsoid a lane: those of a block as the columns of a small table, read by permutation.
// Sixteen gathers of memory take several times as long as the foot that they are for.
#if defined(BODICE_COLLISION_LOOKUP_INL_) == defined(HWY_TARGET_TOGGLE)
#ifdef BODICE_COLLISION_LOOKUP_INL_
#undef BODICE_COLLISION_LOOKUP_INL_
#else
#define BODICE_COLLISION_LOOKUP_INL_
#endif

#include <cstring>
#include <utility>

#include "kernels.hpp"
#include "simd/foot-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::collision::HWY_NAMESPACE {

/// The candidates of some blocks, a column each; rows are the members of BakedEllipsoid, of BakedTable
/// (relief only), the proxy's index, and the members of BoundEllipsoid, all as floats or the bits of
/// integers.
class Columns {
 public:
  static constexpr int kTable = kBakedFloats, kName = kTable + kTableFloats, kBound = kName + 1,
                       kRows = kBound + kBoundFloats;

  /// Which rows are filled beside those of tables and names.
  enum class Rows { kAll, kFeet, kBounds };

  HWY_INLINE void fill(const Baked& baked, const ReliefTables* relief, const std::int32_t* ellipsoids,
                       int count, Rows rows = Rows::kAll) {
    count_ = count;
    ellipsoids_ = ellipsoids;
    if (count <= kPad)
      fill_by<kPad>(baked, relief, ellipsoids, rows);
    else if (count <= 2 * kPad)
      fill_by<2 * kPad>(baked, relief, ellipsoids, rows);
    else
      fill_by<kWidest>(baked, relief, ellipsoids, rows);
  }
  int count() const { return count_; }
  /// Of the proxy's, which column i holds.
  std::size_t ellipsoid(int i) const { return static_cast<std::size_t>(ellipsoids_[i]); }
  const std::int32_t* ellipsoids() const { return ellipsoids_; }
  const float* row(int i) const { return values_ + i * stride_; }

 private:
  static constexpr int kPad = 16;
  // Not a power of two: rows of one column would share their few places in the cache.
  static constexpr int kWidest = kMaxCandidates + kPad;

  // The stride is a constant, so that the copies become plain moves.
  template <int kStride>
  HWY_INLINE void fill_by(const Baked& baked, const ReliefTables* relief, const std::int32_t* ellipsoids,
                          Rows rows) {
    stride_ = kStride;
    for (int c = 0; c < count_; ++c) {
      const auto k = static_cast<std::size_t>(ellipsoids[c]);
      if (rows != Rows::kBounds) put<kStride>(baked.ellipsoids[k], values_ + c);
      if (relief) put<kStride>(relief->tables[k], values_ + kTable * kStride + c);
      put<kStride>(baked.names[k], values_ + kName * kStride + c);
      if (rows != Rows::kFeet) put<kStride, kBoundFloats>(baked.bounds[k], values_ + kBound * kStride + c);
    }
  }
  template <int kStride, int kFloats = 0, class Member>
  static HWY_INLINE void put(const Member& member, float* to) {
    constexpr std::size_t kSize = sizeof(Member) / sizeof(float), kUsed = kFloats == 0 ? kSize : kFloats;
    const auto* const from = reinterpret_cast<const unsigned char*>(&member);
    [&]<std::size_t... i>(std::index_sequence<i...>) {
      (std::memcpy(to + i * kStride, from + i * sizeof(float), sizeof(float)), ...);
    }
    (std::make_index_sequence<kUsed>());
  }

  alignas(64) float values_[kRows * kWidest];
  const std::int32_t* ellipsoids_ = nullptr;
  int stride_ = 0, count_ = 0;
};

/// Reads the columns' rows by lane. kTables: vectors that a row takes, 1 or 2; 0: more, and gathers.
template <int kTables>
class Lookup {
 public:
#if HWY_TARGET == HWY_SCALAR
  explicit HWY_INLINE Lookup(VI column) : column_(hn::GetLane(column)) {}
  HWY_INLINE V operator()(const float* row) const {
    return all(row[column_]);
  }

 private:
  std::int32_t column_;
#else
  explicit HWY_INLINE Lookup(VI column)
      : column_(column),
        index_(hn::IndicesFromVec(f, hn::And(column, hn::Set(I(), kWidth - 1)))),
        second_(hn::RebindMask(f, hn::Gt(column, hn::Set(I(), kWidth - 1)))) {}
  HWY_INLINE V operator()(const float* row) const {
    if constexpr (kTables == 0) return hn::GatherIndex(f, row, column_);
    const V first = hn::TableLookupLanes(hn::Load(f, row), index_);
    if constexpr (kTables == 1) return first;
    return hn::IfThenElse(second_, hn::TableLookupLanes(hn::Load(f, row + kWidth), index_), first);
  }

 private:
  VI column_;
  decltype(hn::IndicesFromVec(f, VI())) index_;
  M second_;
#endif
};

template <int kTables>
HWY_INLINE Shape shape_of(const Columns& columns, VI column) {
  const Lookup<kTables> at(column);
  const auto row = [&](int i) { return at(columns.row(i)); };
  const auto row3 = [&](int i) { return V3{row(i), row(i + 1), row(i + 2)}; };
  return {row3(0), row3(3), row3(6), row3(9), row(12), row(13), row(14), row(15), row(16), row(17), row(18)};
}

template <int kTables>
HWY_INLINE VI names_of(const Columns& columns, VI column) {
  return hn::BitCast(I(), Lookup<kTables>(column)(columns.row(Columns::kName)));
}

/// Calls work with the number of tables as a constant.
template <class Work>
HWY_INLINE void with_tables(const Columns& columns, Work&& work) {
  if (columns.count() <= kWidth)
    work(std::integral_constant<int, 1>());
  else if (columns.count() <= 2 * kWidth)
    work(std::integral_constant<int, 2>());
  else
    work(std::integral_constant<int, 0>());
}

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
