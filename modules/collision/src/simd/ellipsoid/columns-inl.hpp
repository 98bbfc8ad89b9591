// A different ellipsoid in each lane. The candidates of a block are the columns of a small table that is read
// by permutation; sixteen gathers from memory take several times as long as the closest point itself.
#if defined(BODICE_COLLISION_COLUMNS_INL_) == defined(HWY_TARGET_TOGGLE)
#ifdef BODICE_COLLISION_COLUMNS_INL_
#undef BODICE_COLLISION_COLUMNS_INL_
#else
#define BODICE_COLLISION_COLUMNS_INL_
#endif

#include <algorithm>
#include <type_traits>
#include <vector>

#include "model/batch.hpp"
#include "model/proxy_model.hpp"
#include "simd/math/vec3-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::inline v0_1::collision::HWY_NAMESPACE {

#if HWY_TARGET == HWY_SCALAR
/// Copies kFloats numbers of each of four structures into a column each.
template <int kFloats, int kStride>
HWY_INLINE void put_four(const float* const (&from)[4], float* to) {
  for (int i = 0; i < kFloats; ++i)
    for (int c = 0; c < 4; ++c) to[i * kStride + c] = from[c][i];
}
#else
template <int kFloats, int kStride>
HWY_INLINE void put_four(const float* const (&from)[4], float* to) {
  constexpr hn::FixedTag<float, 4> four;
  static_assert(kFloats % 4 == 0);
  for (int i = 0; i < kFloats; i += 4) {
    const auto a = hn::LoadU(four, from[0] + i), b = hn::LoadU(four, from[1] + i);
    const auto c = hn::LoadU(four, from[2] + i), d = hn::LoadU(four, from[3] + i);
    const auto ac = hn::InterleaveLower(four, a, c), bd = hn::InterleaveLower(four, b, d);
    const auto ac2 = hn::InterleaveUpper(four, a, c), bd2 = hn::InterleaveUpper(four, b, d);
    float* const row = to + i * kStride;
    hn::StoreU(hn::InterleaveLower(four, ac, bd), four, row);
    hn::StoreU(hn::InterleaveUpper(four, ac, bd), four, row + kStride);
    hn::StoreU(hn::InterleaveLower(four, ac2, bd2), four, row + 2 * kStride);
    hn::StoreU(hn::InterleaveUpper(four, ac2, bd2), four, row + 3 * kStride);
  }
}
#endif

/// The candidates of some blocks, a column each. The rows are the members of BakedEllipsoid, of BakedTable
/// (relief only) and of BallMap, as floats or as the bits of integers.
class Columns {
 public:
  static constexpr int kBallRows = sizeof(BallMap) / sizeof(float);
  static constexpr int kTable = kBakedFloats, kBall = kTable + kTableFloats, kRows = kBall + kBallRows;
  static constexpr int kProxyIndex = kBakedFloats - 1, kBallProxyIndex = kBall + kBallRows - 1;
  /// Which rows are filled; those of tables are filled whenever there is relief.
  enum class Rows { kAll, kShapes, kBalls };

  HWY_INLINE void fill(const ProxyModel& model, const std::int32_t* ellipsoids, int count,
                       Rows rows = Rows::kAll) {
    count_ = count;
    ellipsoids_ = ellipsoids;
    if (count <= kPad)
      fill_by<kPad>(model, rows);
    else if (count <= 2 * kPad)
      fill_by<2 * kPad>(model, rows);
    else
      fill_by<kWidest>(model, rows);
  }
  int count() const { return count_; }
  /// The internal index of the ellipsoid in column i.
  std::size_t ellipsoid(int i) const { return static_cast<std::size_t>(ellipsoids_[i]); }
  const std::int32_t* ellipsoids() const { return ellipsoids_; }
  const float* row(int i) const { return values_ + i * stride_; }

 private:
  static constexpr int kPad = 16;
  // The widest stride is no power of two, because the rows of one column would then share few cache lines.
  static constexpr int kWidest = kMaxCandidates + kPad;

  // The stride is a constant, so that the copies become plain moves.
  template <int kStride>
  HWY_INLINE void fill_by(const ProxyModel& model, Rows rows) {
    stride_ = kStride;
    for (int c = 0; c < count_; c += 4) {
      if (rows != Rows::kBalls) put<kStride>(model.baked.ellipsoids, c, values_);
      if (model.relief) put<kStride>(model.relief->tables, c, values_ + kTable * kStride);
      if (rows != Rows::kShapes) put<kStride>(model.baked.balls, c, values_ + kBall * kStride);
    }
  }
  /// Fills the columns [c, c + 4); those beyond the last repeat it.
  template <int kStride, class Member>
  HWY_INLINE void put(const std::vector<Member>& members, int c, float* to) {
    const auto numbers = [&](int i) {
      return reinterpret_cast<const float*>(&members[ellipsoid(std::min(c + i, count_ - 1))]);
    };
    put_four<sizeof(Member) / sizeof(float), kStride>({numbers(0), numbers(1), numbers(2), numbers(3)},
                                                      to + c);
  }

  alignas(64) float values_[kRows * kWidest];
  const std::int32_t* ellipsoids_ = nullptr;
  int stride_ = 0, count_ = 0;
};

/// Number of vectors that a permutation reads, and the columns in them. Tables with more columns are read by
/// gathers; the scalar target needs neither.
constexpr int kMostTables = kWidth < 16 ? 4 : 2;
constexpr int kPermuted = kWidth == 1 ? kMaxCandidates : kMostTables * kWidth;

/// Reads the rows of columns, another column in each lane. kTables: vectors in a row, 1, 2 or kMostTables; 0
/// stands for more.
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
      : column_(column), index_(lane_indices(hn::And(column, hn::Set(I(), kWidth - 1)))) {
    for (int t = 1; t < kTables; ++t)
      beyond_[t - 1] = hn::RebindMask(f, hn::Gt(column, hn::Set(I(), t * kWidth - 1)));
  }
  HWY_INLINE V operator()(const float* row) const {
    if constexpr (kTables == 0) return hn::GatherIndex(f, row, column_);
#if HWY_TARGET == HWY_AVX3
    // This is one instruction, for which Highway 1.0 has no function.
    if constexpr (kTables == 2)
      return V{_mm512_permutex2var_ps(hn::Load(f, row).raw, column_.raw, hn::Load(f, row + kWidth).raw)};
#endif
    V value = lookup_lanes(hn::Load(f, row), index_);
    for (int t = 1; t < kTables; ++t)
      value = hn::IfThenElse(beyond_[t - 1], lookup_lanes(hn::Load(f, row + t * kWidth), index_), value);
    return value;
  }

 private:
  VI column_;
  LaneIndices index_;
  M beyond_[kTables > 1 ? kTables - 1 : 1];
#endif
};

/// Reads the columns of the lanes: row i as floats, or as the integers that they stand for.
template <int kTables>
class ColumnLanes {
 public:
  HWY_INLINE ColumnLanes(const Columns& columns, VI column, int first_row = 0)
      : columns_(columns), at_(column), first_row_(first_row) {}

  HWY_INLINE V operator()(int i) const { return at_(columns_.row(first_row_ + i)); }
  HWY_INLINE VI integer(int i) const { return hn::BitCast(I(), (*this)(i)); }

 private:
  const Columns& columns_;
  Lookup<kTables> at_;
  int first_row_;
};

/// Returns work(the number of tables as a constant).
template <class Work>
HWY_INLINE auto with_tables(const Columns& columns, Work&& work) {
  if constexpr (kWidth > 1) {
    if (columns.count() <= kWidth) return work(std::integral_constant<int, 1>());
    if (columns.count() <= 2 * kWidth) return work(std::integral_constant<int, 2>());
    if constexpr (kMostTables > 2)
      if (columns.count() <= kPermuted) return work(std::integral_constant<int, kMostTables>());
  }
  return work(std::integral_constant<int, 0>());
}

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
