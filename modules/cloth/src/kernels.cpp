#include "kernels.hpp"

#include <algorithm>

// The baseline and AVX2: wider vectors would hold four particles to a row, and those are read one by one.
#define HWY_DISABLED_TARGETS \
  (HWY_SSSE3 | HWY_SSE4 | HWY_AVX3 | HWY_AVX3_DL | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#define HWY_BROKEN_EMU128 1
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "kernels.cpp"
#include <hwy/foreach_target.h>
// foreach_target must come first.
#include <hwy/highway.h>

#include "simd/bend-inl.hpp"
#include "simd/stretch-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::cloth::HWY_NAMESPACE {

static_assert(kPack % kLanes == 0);

void solve_stretch(const StretchConstraints& c, PackRange packs, float inverse_h2, Point* p) {
  for (std::size_t slot = packs.begin * kPack; slot < packs.end * kPack; slot += kLanes)
    solve_edges(c, slot, all(inverse_h2), p);
}

void solve_bend(BendConstraints& c, PackRange packs, float inverse_h2, Point* p) {
  for (std::size_t slot = packs.begin * kPack; slot < packs.end * kPack; slot += kLanes)
    solve_hinges(c, slot, all(inverse_h2), p);
}

Strain measure_stretch(const StretchConstraints& c, PackRange packs, const Point* p, float* strain) {
  Strain out;
  Lanes longest = all(0.0f);
  for (std::size_t slot = packs.begin * kPack; slot < packs.end * kPack; slot += kLanes) {
    Lanes own;
    out.energy_j += 0.5 * static_cast<double>(sum(measure_edges(c, slot, p, own)));
    write(strain + slot, own);
    longest = larger(longest, own);
  }
  for (std::size_t k = 0; k < kLanes; ++k) out.longest = std::max(out.longest, longest[k]);
  return out;
}

double bend_energy(const BendConstraints& c, PackRange packs, const Point* p) {
  double energy = 0.0;
  for (std::size_t slot = packs.begin * kPack; slot < packs.end * kPack; slot += kLanes)
    energy += 0.5 * static_cast<double>(sum(hinge_energies(c, slot, p)));
  return energy;
}

}  // namespace bodice::cloth::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace bodice::cloth {

HWY_EXPORT(solve_stretch);
HWY_EXPORT(solve_bend);
HWY_EXPORT(measure_stretch);
HWY_EXPORT(bend_energy);

void solve_stretch_packs(const StretchConstraints& c, PackRange packs, float inverse_h2, Point* p) {
  HWY_DYNAMIC_DISPATCH(solve_stretch)(c, packs, inverse_h2, p);
}

void solve_bend_packs(BendConstraints& c, PackRange packs, float inverse_h2, Point* p) {
  HWY_DYNAMIC_DISPATCH(solve_bend)(c, packs, inverse_h2, p);
}

Strain measure_stretch_packs(const StretchConstraints& c, PackRange packs, const Point* p,
                             std::span<float> strain) {
  return HWY_DYNAMIC_DISPATCH(measure_stretch)(c, packs, p, strain.data());
}

double bend_energy_packs(const BendConstraints& c, PackRange packs, const Point* p) {
  return HWY_DYNAMIC_DISPATCH(bend_energy)(c, packs, p);
}

}  // namespace bodice::cloth
#endif
