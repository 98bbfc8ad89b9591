// The proxy's distance at one vector of particles of a block, among the block's candidates.
#if defined(BODICE_COLLISION_SAMPLE_INL_) == defined(HWY_TARGET_TOGGLE)
#ifdef BODICE_COLLISION_SAMPLE_INL_
#undef BODICE_COLLISION_SAMPLE_INL_
#else
#define BODICE_COLLISION_SAMPLE_INL_
#endif

#include "simd/broad/tangent_candidates-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::collision::HWY_NAMESPACE {

struct Sample {
  V distance;   ///< F, meters; what `distance` was at the start where every
                ///< ellipsoid is farther
  V3 gradient;  ///< unit for plain ellipsoids
  VI owner;
};

/// The tangent-plane bound of candidate c at p.
HWY_INLINE V tangent_bound(const TangentCandidates& c, int i, V3 p) {
  const V3 offset = p - broadcast3(c.middle);
  return hn::MulAdd(
      all(c.nx[i]), offset.x,
      hn::MulAdd(all(c.ny[i]), offset.y, hn::MulAdd(all(c.nz[i]), offset.z, all(c.distance[i]))));
}

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
