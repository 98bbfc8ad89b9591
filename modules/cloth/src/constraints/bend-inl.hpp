// Solving and measuring a vector of hinges.
#if defined(BODICE_CLOTH_BEND_INL_) == defined(HWY_TARGET_TOGGLE)
#ifdef BODICE_CLOTH_BEND_INL_
#undef BODICE_CLOTH_BEND_INL_
#else
#define BODICE_CLOTH_BEND_INL_
#endif

#include "base/tolerances.hpp"
#include "constraints/bend.hpp"
#include "constraints/lanes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::inline v0_1::cloth::HWY_NAMESPACE {

/// The state of a vector of hinges.
struct Bent {
  Lanes value;       // n . K x - rest
  Lanes nx, ny, nz;  // unit normal; zero where the hinge is folded shut
};

template <int k>
HWY_INLINE Lanes stencil_row(const Lanes (&weight)[4], Lanes e, Lanes to_c, Lanes to_d) {
  return spread<k>(weight[1]) * e + spread<k>(weight[2]) * to_c + spread<k>(weight[3]) * to_d;
}

/// Measures hinges with their corners at at[corner][row].
HWY_INLINE Bent measure_bend(Lanes rest, const Lanes (&at)[4][4], const Lanes (&weight)[4]) {
  Lanes e[4], f[4], to_c[4], to_d[4];
  for (std::size_t k = 0; k < 4; ++k) {
    // Differences to the first corner suffice, because the weights sum to zero, and they keep more digits.
    to_c[k] = at[2][k] - at[0][k], to_d[k] = at[3][k] - at[0][k];
    e[k] = at[1][k] - at[0][k], f[k] = to_c[k] - to_d[k];
  }
  Lanes bent[4] = {
      stencil_row<0>(weight, e[0], to_c[0], to_d[0]), stencil_row<1>(weight, e[1], to_c[1], to_d[1]),
      stencil_row<2>(weight, e[2], to_c[2], to_d[2]), stencil_row<3>(weight, e[3], to_c[3], to_d[3])};
  transpose_blocks(e[0], e[1], e[2], e[3]);
  transpose_blocks(f[0], f[1], f[2], f[3]);
  transpose_blocks(bent[0], bent[1], bent[2], bent[3]);
  const Lanes nx = e[1] * f[2] - e[2] * f[1], ny = e[2] * f[0] - e[0] * f[2], nz = e[0] * f[1] - e[1] * f[0];
  const Lanes scale = 1.0f / square_root(nx * nx + ny * ny + nz * nz + kTinyLength2);
  const Lanes along = nx * bent[0] + ny * bent[1] + nz * bent[2];
  return {scale * along - rest, scale * nx, scale * ny, scale * nz};
}

template <class Id>
HWY_INLINE void read_hinges(const HingePack<Id>& pack, std::size_t first, const Point* p, Lanes (&at)[4][4],
                            Lanes (&weight)[4]) {
  for (std::size_t q = 0; q < 4; ++q)
    for (std::size_t k = 0; k < 4; ++k) at[q][k] = read_points(p, &pack.corner[q][first + k]);
  for (std::size_t q = 1; q < 4; ++q) weight[q] = read(&pack.k[q - 1][first]);
  weight[0] = -(weight[1] + weight[2] + weight[3]);
}

/// Solves the hinges in the slots from `first` on; a hinge beyond the limit of friction slips.
template <class Id>
HWY_INLINE void solve_hinges(HingePack<Id>& pack, std::size_t first, const YarnFriction& yarn,
                             Lanes inverse_h2, Point* p) {
  Lanes at[4][4], weight[4], w[4];
  read_hinges(pack, first, p, at, weight);
  const Bent bent = measure_bend(read(&pack.rest_m[first]), at, weight);
  const Lanes compliance = read(&pack.compliance[first]), slip = yarn.slip_n * compliance;
  // The held value stays within `slip` of the hinge's value. A value that is NaN leaves it unchanged.
  const Lanes held = smaller(bent.value + slip, larger(bent.value - slip, read(&pack.held[first])));
  write(&pack.held[first], held);
  // The springs to the rest shape and to the held value are combined into one.
  Lanes yielding = yarn.soften * compliance * inverse_h2 + kTinyWeight;
  for (std::size_t q = 0; q < 4; ++q) {
    w[q] = weights_of(at[q][0], at[q][1], at[q][2], at[q][3]) * weight[q];
    yielding += w[q] * weight[q];
  }
  const Lanes move = ((1.0f - yarn.soften) * held - bent.value) / yielding;
  Lanes m[4] = {move * bent.nx, move * bent.ny, move * bent.nz, all(0.0f)};
  transpose_blocks(m[0], m[1], m[2], m[3]);
  for (std::size_t q = 0; q < 4; ++q) {
    const Id* const corner = &pack.corner[q][first];
    write_points(p, corner, at[q][0] + spread<0>(w[q]) * m[0]);
    write_points(p, corner + 1, at[q][1] + spread<1>(w[q]) * m[1]);
    write_points(p, corner + 2, at[q][2] + spread<2>(w[q]) * m[2]);
    write_points(p, corner + 3, at[q][3] + spread<3>(w[q]) * m[3]);
  }
}

/// Twice the energies of the hinges in the slots from `first` on, joules, with those of the springs of
/// friction.
template <class Id>
HWY_INLINE Lanes hinge_energies(const HingePack<Id>& pack, std::size_t first, const YarnFriction& yarn,
                                const Point* p) {
  Lanes at[4][4], weight[4];
  read_hinges(pack, first, p, at, weight);
  const Lanes value = measure_bend(read(&pack.rest_m[first]), at, weight).value;
  const Lanes slack = value - read(&pack.held[first]);
  const float stick = 1.0f / yarn.soften - 1.0f;
  return (value * value + stick * slack * slack) / read(&pack.compliance[first]);
}

}  // namespace bodice::cloth::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
