// An ellipsoid a lane, and the closest point on it.
#if defined(BODICE_COLLISION_SHAPE_INL_) == defined(HWY_TARGET_TOGGLE)
#ifdef BODICE_COLLISION_SHAPE_INL_
#undef BODICE_COLLISION_SHAPE_INL_
#else
#define BODICE_COLLISION_SHAPE_INL_
#endif

#include <cstddef>

#include "model/baked.hpp"
#include "simd/math/vec3-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::inline v0_1::collision::HWY_NAMESPACE {

/// The numbers of BakedEllipsoid: one ellipsoid in every lane, or another one in each.
struct Shape {
  V3 center, row0, row1, row2;
  V radius1, radius2, gap0, gap1, inverse1, inverse2, longest;
};

HWY_INLINE Shape broadcast(const BakedEllipsoid& e) {
  return {broadcast3(e.center),
          broadcast3(e.to_unit),
          broadcast3(e.to_unit + 3),
          broadcast3(e.to_unit + 6),
          all(e.radius1),
          all(e.radius2),
          all(e.gap0),
          all(e.gap1),
          all(e.inverse1),
          all(e.inverse2),
          all(e.longest_m)};
}

/// `row` reads the members of BakedEllipsoid by their index, another ellipsoid in each lane.
template <class Row>
HWY_INLINE Shape shape_from(Row&& row) {
  const auto row3 = [&](int i) { return V3{row(i), row(i + 1), row(i + 2)}; };
  return {row3(0), row3(3), row3(6), row3(9), row(12), row(13), row(14), row(15), row(16), row(17), row(18)};
}

HWY_INLINE Shape select(M m, const Shape& yes, const Shape& no) {
  const auto one = [m](V a, V b) { return hn::IfThenElse(m, a, b); };
  return {select(m, yes.center, no.center), select(m, yes.row0, no.row0), select(m, yes.row1, no.row1),
          select(m, yes.row2, no.row2),     one(yes.radius1, no.radius1), one(yes.radius2, no.radius2),
          one(yes.gap0, no.gap0),           one(yes.gap1, no.gap1),       one(yes.inverse1, no.inverse1),
          one(yes.inverse2, no.inverse2),   one(yes.longest, no.longest)};
}

HWY_INLINE V field(const CullArrays& cull, std::size_t which, std::size_t k) {
  return hn::LoadU(f, cull.baked[which].data() + k);
}
HWY_INLINE V3 field3(const CullArrays& cull, std::size_t which, std::size_t k) {
  return {field(cull, which, k), field(cull, which + 1, k), field(cull, which + 2, k)};
}

/// Ellipsoid k + lane in each lane.
HWY_INLINE Shape consecutive(const CullArrays& c, std::size_t k) {
  return {field3(c, 0, k), field3(c, 3, k), field3(c, 6, k), field3(c, 9, k),
          field(c, 12, k), field(c, 13, k), field(c, 14, k), field(c, 15, k),
          field(c, 16, k), field(c, 17, k), field(c, 18, k)};
}

/// The closest points of one vector of particles, in the frames of their ellipsoids.
struct ClosestPointLanes {
  V distance;  ///< meters, negative inside
  V3 n;        ///< outward normal times r0, in the octant and axes of w
  V3 w;        ///< w of [1], in the first octant, axes by falling radius
  V3 y;        ///< the particle in the ellipsoid's frame, signed, in units of r0
  V u;         ///< the root of [2]
};

/// Rotates a vector from the ellipsoid's frame, axes by falling radius, to the collider's local frame, and
/// divides it by r0.
HWY_INLINE V3 out_of(const Shape& s, V3 v) {
  return {hn::MulAdd(s.row0.x, v.x, hn::MulAdd(s.row1.x, v.y, hn::Mul(s.row2.x, v.z))),
          hn::MulAdd(s.row0.y, v.x, hn::MulAdd(s.row1.y, v.y, hn::Mul(s.row2.y, v.z))),
          hn::MulAdd(s.row0.z, v.x, hn::MulAdd(s.row1.z, v.y, hn::Mul(s.row2.z, v.z)))};
}

/// The outward unit normal in the collider's local frame.
HWY_INLINE V3 normal_of(const Shape& s, const ClosestPointLanes& closest) {
  return out_of(s, with_signs(closest.n, signs_of(closest.y)));
}

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
