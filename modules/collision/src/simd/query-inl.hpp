// Signed distance, normal and owner for a block.
#if defined(BODICE_COLLISION_QUERY_INL_) == defined(HWY_TARGET_TOGGLE)
#ifdef BODICE_COLLISION_QUERY_INL_
#undef BODICE_COLLISION_QUERY_INL_
#else
#define BODICE_COLLISION_QUERY_INL_
#endif

#include "simd/sample-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::collision::HWY_NAMESPACE {

HWY_INLINE bool query_lanes(const Baked& baked, const ReliefTables* relief, const Block& block,
                            BlockContacts& out) {
  Candidates candidates;
  if (!cull_for_query(baked, block, relief ? relief->blend_m : 0.0f, candidates)) return false;
  out.radius_m = candidates.radius_m;
  const int width = static_cast<int>(hn::Lanes(f));
  for (int i = 0; i < block.count; i += width) {
    const V3 p = load3(block.x + i, block.y + i, block.z + i);
    const Sample s = sample(baked, relief, candidates, p, all(1e30f));
    const V3 normal = relief ? unit(s.gradient) : s.gradient;
    hn::Store(s.distance, f, out.distance + i);
    store3(normal, out.nx + i, out.ny + i, out.nz + i);
    hn::Store(s.owner, I(), reinterpret_cast<std::int32_t*>(out.owner) + i);
  }
  return true;
}

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
