#include "constraints/kernels.hpp"

#include <algorithm>

// The targets are the baseline and AVX2. Wider vectors would not help, because particles are read one by one.
// On x86 the bits below that of AVX3 belong to wider targets, and new versions of Highway add more of them.
#define HWY_DISABLED_TARGETS                                                                            \
  (HWY_SSSE3 | HWY_SSE4 | HWY_AVX3 | (HWY_AVX3 - 1) | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | \
   HWY_RVV)
#define HWY_BROKEN_EMU128 1
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "constraints/kernels.cpp"
#include <hwy/foreach_target.h>
// foreach_target must come first.
#include <hwy/highway.h>

#include "constraints/bend-inl.hpp"
#include "constraints/stretch-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::inline v0_1::cloth::HWY_NAMESPACE {

static_assert(kPack % kLanes == 0);

template <class Id>
void solve_stretch(std::span<const EdgePack<Id>> packs, float longest, float inverse_h2, Point* p) {
  for (const EdgePack<Id>& pack : packs)
    for (std::size_t k = 0; k < kPack; k += kLanes) solve_edges(pack, k, all(longest), all(inverse_h2), p);
}

template <class Id>
void solve_bend(std::span<HingePack<Id>> packs, const YarnFriction& yarn, float inverse_h2, Point* p) {
  for (HingePack<Id>& pack : packs)
    for (std::size_t k = 0; k < kPack; k += kLanes) solve_hinges(pack, k, yarn, all(inverse_h2), p);
}

template <class Id>
Strain measure_stretch(std::span<const EdgePack<Id>> packs, const Point* p, float* strain) {
  Strain out;
  Lanes longest = all(0.0f);
  for (const EdgePack<Id>& pack : packs) {
    for (std::size_t k = 0; k < kPack; k += kLanes, strain += kLanes) {
      Lanes own;
      out.energy_j += 0.5 * static_cast<double>(sum(measure_edges(pack, k, p, own)));
      write(strain, own);
      longest = larger(longest, own);
    }
  }
  for (std::size_t k = 0; k < kLanes; ++k) out.longest = std::max(out.longest, longest[k]);
  return out;
}

template <class Id>
double bend_energy(std::span<const HingePack<Id>> packs, const YarnFriction& yarn, const Point* p) {
  double energy = 0.0;
  for (const HingePack<Id>& pack : packs)
    for (std::size_t k = 0; k < kPack; k += kLanes)
      energy += 0.5 * static_cast<double>(sum(hinge_energies(pack, k, yarn, p)));
  return energy;
}

// Highway exports functions, not templates.
void solve_stretch_inside(std::span<const EdgePack<Local>> packs, float longest, float inverse_h2, Point* p) {
  solve_stretch(packs, longest, inverse_h2, p);
}
void solve_stretch_across(std::span<const EdgePack<Index>> packs, float longest, float inverse_h2, Point* p) {
  solve_stretch(packs, longest, inverse_h2, p);
}
void solve_bend_inside(std::span<HingePack<Local>> packs, const YarnFriction& yarn, float inverse_h2,
                       Point* p) {
  solve_bend(packs, yarn, inverse_h2, p);
}
void solve_bend_across(std::span<HingePack<Index>> packs, const YarnFriction& yarn, float inverse_h2,
                       Point* p) {
  solve_bend(packs, yarn, inverse_h2, p);
}
Strain measure_stretch_inside(std::span<const EdgePack<Local>> packs, const Point* p, float* strain) {
  return measure_stretch(packs, p, strain);
}
Strain measure_stretch_across(std::span<const EdgePack<Index>> packs, const Point* p, float* strain) {
  return measure_stretch(packs, p, strain);
}
double bend_energy_inside(std::span<const HingePack<Local>> packs, const YarnFriction& yarn, const Point* p) {
  return bend_energy(packs, yarn, p);
}
double bend_energy_across(std::span<const HingePack<Index>> packs, const YarnFriction& yarn, const Point* p) {
  return bend_energy(packs, yarn, p);
}

}  // namespace bodice::cloth::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace bodice::inline v0_1::cloth {

HWY_EXPORT(solve_stretch_inside);
HWY_EXPORT(solve_stretch_across);
HWY_EXPORT(solve_bend_inside);
HWY_EXPORT(solve_bend_across);
HWY_EXPORT(measure_stretch_inside);
HWY_EXPORT(measure_stretch_across);
HWY_EXPORT(bend_energy_inside);
HWY_EXPORT(bend_energy_across);

void solve_packs(std::span<const EdgePack<Local>> packs, float longest, float inverse_h2, Point* p) {
  HWY_DYNAMIC_DISPATCH(solve_stretch_inside)(packs, longest, inverse_h2, p);
}
void solve_packs(std::span<const EdgePack<Index>> packs, float longest, float inverse_h2, Point* p) {
  HWY_DYNAMIC_DISPATCH(solve_stretch_across)(packs, longest, inverse_h2, p);
}
void solve_packs(std::span<HingePack<Local>> packs, const YarnFriction& yarn, float inverse_h2, Point* p) {
  HWY_DYNAMIC_DISPATCH(solve_bend_inside)(packs, yarn, inverse_h2, p);
}
void solve_packs(std::span<HingePack<Index>> packs, const YarnFriction& yarn, float inverse_h2, Point* p) {
  HWY_DYNAMIC_DISPATCH(solve_bend_across)(packs, yarn, inverse_h2, p);
}

Strain measure_packs(std::span<const EdgePack<Local>> packs, const Point* p, float* strain) {
  return HWY_DYNAMIC_DISPATCH(measure_stretch_inside)(packs, p, strain);
}
Strain measure_packs(std::span<const EdgePack<Index>> packs, const Point* p, float* strain) {
  return HWY_DYNAMIC_DISPATCH(measure_stretch_across)(packs, p, strain);
}
double energy_of_packs(std::span<const HingePack<Local>> packs, const YarnFriction& yarn, const Point* p) {
  return HWY_DYNAMIC_DISPATCH(bend_energy_inside)(packs, yarn, p);
}
double energy_of_packs(std::span<const HingePack<Index>> packs, const YarnFriction& yarn, const Point* p) {
  return HWY_DYNAMIC_DISPATCH(bend_energy_across)(packs, yarn, p);
}

}  // namespace bodice::cloth
#endif
