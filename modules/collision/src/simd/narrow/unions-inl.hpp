// What a result is: the policies of the narrow phase. A policy turns the closest point of one ellipsoid into
// a Result. Result::distance decides which ellipsoid owns a particle: in a pose it is the score, the distance
// plus kappa times the burial.
#if defined(BODICE_COLLISION_UNIONS_INL_) == defined(HWY_TARGET_TOGGLE)
#ifdef BODICE_COLLISION_UNIONS_INL_
#undef BODICE_COLLISION_UNIONS_INL_
#else
#define BODICE_COLLISION_UNIONS_INL_
#endif

#include <cstddef>

#include "model/fallback.hpp"
#include "model/proxy_model.hpp"
#include "simd/ellipsoid/columns-inl.hpp"
#include "simd/ellipsoid/relief_table-inl.hpp"
#include "simd/ellipsoid/shape-inl.hpp"
#include "simd/narrow/pairs-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::inline v0_1::collision::HWY_NAMESPACE {

/// The proxy as the union of plain ellipsoids: its distance is that of the nearest ellipsoid.
struct PlainUnion {
  static constexpr bool kBlends = false, kBuries = false;
  static constexpr int kLowest = 2;  ///< candidates of a particle that are found in one pass
  const ProxyModel& model;

  /// The result of the ellipsoids in some columns, one a lane, from their closest points.
  template <int kTables>
  HWY_INLINE Result result(const Columns& columns, VI column, const Shape& shape,
                           const ClosestPointLanes& closest) const {
    const ColumnLanes<kTables> at(columns, column);
    return {closest.distance, closest.distance, normal_of(shape, closest), at.integer(Columns::kProxyIndex),
            closest.distance};
  }
  /// The result of one ellipsoid in all lanes.
  HWY_INLINE Result result_of_one(std::size_t ellipsoid, const Shape& shape,
                                  const ClosestPointLanes& closest) const {
    return {closest.distance, closest.distance, normal_of(shape, closest),
            hn::Set(I(), model.baked.proxy_index[ellipsoid]), closest.distance};
  }
};

/// The proxy with relief: each ellipsoid's distance is corrected by its table, and those within the blend
/// radius of the nearest are blended. In a pose of a bound proxy (kPosed) burial counts.
template <bool kPosed>
struct TableUnion {
  static constexpr bool kBlends = true, kBuries = kPosed;
  static constexpr int kLowest = 3;
  const ProxyModel& model;

  const ReliefTables& relief() const { return *model.relief; }
  template <int kTables>
  HWY_INLINE Result result(const Columns& columns, VI column, const Shape& shape,
                           const ClosestPointLanes& closest) const {
    const ColumnLanes<kTables> at(columns, column), of_table(columns, column, Columns::kTable);
    const VI proxy_index = at.integer(Columns::kProxyIndex);
    return scored(closest.distance,
                  corrected<kPosed>(relief(), table_from(of_table), shape, closest,
                                    [&] { return axes_from(of_table); }),
                  proxy_index);
  }
  HWY_INLINE Result result_of_one(std::size_t ellipsoid, const Shape& shape,
                                  const ClosestPointLanes& closest) const {
    const BakedTable& table = relief().tables[ellipsoid];
    return scored(
        closest.distance,
        corrected<kPosed>(relief(), broadcast(table), shape, closest, [&] { return axes_of(table); }),
        hn::Set(I(), model.baked.proxy_index[ellipsoid]));
  }

 private:
  static HWY_INLINE Result scored(V distance, const Corrected& one, VI proxy_index) {
    if constexpr (kPosed)
      return {hn::Add(distance, one.burial), one.value, one.gradient, proxy_index, distance};
    else
      return {distance, one.value, one.gradient, proxy_index, distance};
  }
};
using ReliefUnion = TableUnion<false>;
using PosedUnion = TableUnion<true>;

/// Calls work with the policy of the proxy: PlainUnion, ReliefUnion or PosedUnion.
template <class Work>
HWY_INLINE Status with_union(const ProxyModel& model, Work&& work) {
  if (model.buries()) return work(PosedUnion{model});
  if (model.relief) return work(ReliefUnion{model});
  return work(PlainUnion{model});
}

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
