// Solving and measuring a vector of edges.
#if defined(BODICE_CLOTH_STRETCH_INL_) == defined(HWY_TARGET_TOGGLE)
#ifdef BODICE_CLOTH_STRETCH_INL_
#undef BODICE_CLOTH_STRETCH_INL_
#else
#define BODICE_CLOTH_STRETCH_INL_
#endif

#include "base/tolerances.hpp"
#include "constraints/lanes-inl.hpp"
#include "constraints/stretch.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::inline v0_1::cloth::HWY_NAMESPACE {

/// Solves the edges in the slots from `first` on. `longest` is the allowed length, in rest lengths.
template <class Id>
HWY_INLINE void solve_edges(const EdgePack<Id>& pack, std::size_t first, Lanes longest, Lanes inverse_h2,
                            Point* p) {
  const Id *a = &pack.a[first], *b = &pack.b[first];
  Lanes at_a[4], at_b[4], d[4];
  for (std::size_t k = 0; k < 4; ++k) {
    at_a[k] = read_points(p, a + k), at_b[k] = read_points(p, b + k);
    d[k] = without_weight(at_a[k] - at_b[k]);
  }
  const Lanes wa = weights_of(at_a[0], at_a[1], at_a[2], at_a[3]);
  const Lanes wb = weights_of(at_b[0], at_b[1], at_b[2], at_b[3]);
  Lanes x = d[0], y = d[1], z = d[2], none = d[3];
  transpose_blocks(x, y, z, none);
  const Lanes length = square_root(x * x + y * y + z * z + kTinyLength2);
  // This is the larger of (length - rest) / yielding and (length - limit) / w, over the length, with one
  // division. The second exceeds the first only beyond the limit.
  const Lanes rest = read(&pack.rest_m[first]);
  const Lanes w = wa + wb + kTinyWeight, yielding = w + read(&pack.compliance[first]) * inverse_h2;
  const Lanes soft = (length - rest) * w, hard = (length - longest * rest) * yielding;
  const Lanes scale = larger(soft, hard) / (w * yielding * length);
  const Lanes to_a = scale * wa, to_b = scale * wb;
  write_points(p, a, at_a[0] - spread<0>(to_a) * d[0]);
  write_points(p, b, at_b[0] + spread<0>(to_b) * d[0]);
  write_points(p, a + 1, at_a[1] - spread<1>(to_a) * d[1]);
  write_points(p, b + 1, at_b[1] + spread<1>(to_b) * d[1]);
  write_points(p, a + 2, at_a[2] - spread<2>(to_a) * d[2]);
  write_points(p, b + 2, at_b[2] + spread<2>(to_b) * d[2]);
  write_points(p, a + 3, at_a[3] - spread<3>(to_a) * d[3]);
  write_points(p, b + 3, at_b[3] + spread<3>(to_b) * d[3]);
}

/// Measures the strains of the edges in the slots from `first` on; returns twice their energies, joules.
template <class Id>
HWY_INLINE Lanes measure_edges(const EdgePack<Id>& pack, std::size_t first, const Point* p, Lanes& strain) {
  Lanes d[4];
  for (std::size_t k = 0; k < 4; ++k)
    d[k] = read_points(p, &pack.a[first + k]) - read_points(p, &pack.b[first + k]);
  transpose_blocks(d[0], d[1], d[2], d[3]);
  const Lanes rest = read(&pack.rest_m[first]);
  const Lanes longer = square_root(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]) - rest;
  strain = longer / (rest + 1e-30f);
  return longer * longer / read(&pack.compliance[first]);
}

}  // namespace bodice::cloth::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
