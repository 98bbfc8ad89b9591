// Distance of the smooth union at one vector of particles, and the bound that excludes candidates.
#if defined(BODICE_COLLISION_SAMPLE_INL_) == defined(HWY_TARGET_TOGGLE)
#ifdef BODICE_COLLISION_SAMPLE_INL_
#undef BODICE_COLLISION_SAMPLE_INL_
#else
#define BODICE_COLLISION_SAMPLE_INL_
#endif

#include "simd/broad/tangent_candidates-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::collision::HWY_NAMESPACE {

/// The distance of the smooth union in each lane.
struct Sample {
  V distance;   ///< F, meters; where every ellipsoid is farther, its initial value
  V3 gradient;  ///< unit length for plain ellipsoids
  VI owner;
};

/// Lower bound on candidate i's distance at p, by its tangent plane.
HWY_INLINE V tangent_bound(const TangentCandidates& c, int i, V3 p) {
  const V3 offset = p - broadcast3(c.middle);
  return hn::MulAdd(
      all(c.nx[i]), offset.x,
      hn::MulAdd(all(c.ny[i]), offset.y, hn::MulAdd(all(c.nz[i]), offset.z, all(c.distance[i]))));
}

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
