// A different ellipsoid a lane: up to sixteen of them as the columns of a small table, read by permutation.
// Sixteen gathers of memory take several times as long as the foot that they are for.
#if defined(BODICE_COLLISION_LOOKUP_INL_) == defined(HWY_TARGET_TOGGLE)
#ifdef BODICE_COLLISION_LOOKUP_INL_
#undef BODICE_COLLISION_LOOKUP_INL_
#else
#define BODICE_COLLISION_LOOKUP_INL_
#endif

#include <array>
#include <bit>

#include "relief.hpp"
#include "simd/foot-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::collision::HWY_NAMESPACE {

constexpr int kColumns = 16;

/// Some of the proxy's ellipsoids, a column each; rows are the members of BakedEllipsoid, in order.
struct Columns {
  alignas(64) float row[kBakedFloats][kColumns];
  alignas(64) float table[8][kColumns];  ///< relief only: the members of BakedTable; bits of integers
  alignas(64) float name[kColumns];      ///< bits of the proxy's index
  std::int32_t ellipsoid[kColumns];
  int count = 0;

  bool full() const { return count == kColumns; }

  int add(const Baked& baked, const ReliefTables* relief, std::int32_t k) {
    const auto values =
        std::bit_cast<std::array<float, kBakedFloats>>(baked.ellipsoids[static_cast<std::size_t>(k)]);
    for (std::size_t i = 0; i < values.size(); ++i) row[i][count] = values[i];
    if (relief) add_table(relief->tables[static_cast<std::size_t>(k)]);
    name[count] = std::bit_cast<float>(baked.names[static_cast<std::size_t>(k)]);
    ellipsoid[count] = k;
    return count++;
  }

  /// The column of ellipsoid k, which is added if it is not there; the table must not be full.
  int find_or_add(const Baked& baked, const ReliefTables* relief, std::int32_t k) {
    for (int c = 0; c < count; ++c)
      if (ellipsoid[c] == k) return c;
    return add(baked, relief, k);
  }

 private:
  void add_table(const BakedTable& t) {
    const float values[8] = {std::bit_cast<float>(t.first_byte),
                             std::bit_cast<float>(t.nodes),
                             t.h_scale_m,
                             t.h_offset_m,
                             t.a_scale,
                             t.a_offset,
                             std::bit_cast<float>(t.sorted_axis[0]),
                             std::bit_cast<float>(t.sorted_axis[1])};
    for (int i = 0; i < 8; ++i) table[i][count] = values[i];
  }
};

/// Reads the columns' rows by lane. kTables: vectors a row takes as far as it is in use; 0 gathers.
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
  const auto row = [&](int i) { return at(columns.row[i]); };
  const auto row3 = [&](int i) { return V3{row(i), row(i + 1), row(i + 2)}; };
  return {row3(0), row3(3), row3(6), row3(9), row(12), row(13), row(14), row(15), row(16), row(17), row(18)};
}

template <int kTables>
HWY_INLINE VI names_of(const Columns& columns, VI column) {
  return hn::BitCast(I(), Lookup<kTables>(column)(columns.name));
}

/// Calls work with the number of tables as a constant.
template <class Work>
HWY_INLINE void with_tables(const Columns& columns, Work&& work) {
  if (kWidth >= kColumns || columns.count <= kWidth)
    work(std::integral_constant<int, 1>());
  else if (columns.count <= 2 * kWidth)
    work(std::integral_constant<int, 2>());
  else
    work(std::integral_constant<int, 0>());
}

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
