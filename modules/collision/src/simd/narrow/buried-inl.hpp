// Poses, to first order: particles of which the nearest ellipsoid is buried. The owner has the least score,
// and is nearly always one of the two that come next; what else may own a particle is left to the exact
// query.
#if defined(BODICE_COLLISION_BURIED_INL_) == defined(HWY_TARGET_TOGGLE)
#ifdef BODICE_COLLISION_BURIED_INL_
#undef BODICE_COLLISION_BURIED_INL_
#else
#define BODICE_COLLISION_BURIED_INL_
#endif

#include <algorithm>
#include <bit>
#include <cstddef>

#include "simd/narrow/pairs-inl.hpp"
#include "simd/narrow/query-inl.hpp"
#include "simd/narrow/unions-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace bodice::inline v0_1::collision::HWY_NAMESPACE {

/// One vector of particles with their nearest ellipsoids.
struct NearestToFirstOrder {
  V distance, score;  ///< to the nearest ellipsoid, meters, and with its burial
  V known;            ///< score up to which the candidates certainly hold the owner, meters
  V next[3];          ///< first-order distances of the candidates that follow, rising, meters
  VI second, third;   ///< columns of the first two of these
};

/// The buried particles of some ranges, closed up, and pairs of them with the candidates that follow.
struct alignas(64) BuriedParticles {
  static constexpr int kFollowing = 2;
  static constexpr int kSize = kBatch + 16, kPairs = kFollowing * kBatch + 4 * kStep;
  std::int32_t lane[kSize];
  float score_m[kSize], burial_m[kSize], known_m[kSize];
  float after_m[kSize];  ///< first-order distance of the first candidate that is in no pair
  int count = 0;
  std::int32_t pair_lane[kPairs], pair_column[kPairs];
  float pair_score_m[kPairs], pair_burial_m[kPairs];
  alignas(
      Contact) std::byte contacts[kPairs * sizeof(Contact)];  ///< not filled with defaults, which takes time
  int pairs = 0;
  LaneBits to_exact;  ///< lanes that are left to the exact query

  void clear() { count = pairs = 0; }
  Contact* contact(int pair) { return reinterpret_cast<Contact*>(contacts) + pair; }
  /// Adds the particles of the lanes [first, first + kWidth) that are buried and among `real`.
  HWY_INLINE void add(M real, int first, const NearestToFirstOrder& at, V blend) {
    const V burial = hn::Sub(at.score, at.distance);
    const M buried = hn::And(hn::Gt(burial, hn::Zero(f)), real);
    const M uncertain = hn::Or(hn::Gt(at.score, at.known), hn::Gt(burial, blend));
    const M contested = hn::Or(hn::Lt(at.next[0], at.score), uncertain);
    const M open = hn::And(buried, contested);
    if (HWY_LIKELY(hn::AllFalse(f, open))) return;
    const VI lanes = lanes_from(first);
    const Pack pack(open);
    pack.store(lanes, lane + count);
    pack.store(at.score, score_m + count);
    pack.store(burial, burial_m + count);
    pack.store(at.known, known_m + count);
    pack.store(at.next[kFollowing], after_m + count);
    count += pack.count();
    add_pairs(hn::And(open, hn::Lt(at.next[0], at.score)), lanes, at.second);
    add_pairs(hn::And(open, hn::Lt(at.next[1], at.score)), lanes, at.third);
  }
  /// Repeats the last pair until there are whole steps.
  void pad(int step) {
    for (int i = pairs; i % step != 0; ++i) {
      pair_lane[i] = pair_lane[pairs - 1];
      pair_column[i] = pair_column[pairs - 1];
    }
  }
  /// Writes the contacts of pairs that have a lower score than the nearest ellipsoid. It leaves to the exact
  /// query the particles of which the owner may be in no pair, or is buried itself: then scores to first
  /// order are too near each other to choose by.
  void write_least(const ContactOutput& out, float blend_m) {
    float least_m[kBatch], of_least_m[kBatch];
    for (int i = 0; i < count; ++i) least_m[lane[i]] = score_m[i], of_least_m[lane[i]] = burial_m[i];
    for (int i = 0; i < pairs; ++i) {
      float& least = least_m[pair_lane[i]];
      if (!(pair_score_m[i] < least)) continue;
      least = pair_score_m[i];
      of_least_m[pair_lane[i]] = pair_burial_m[i];
      out.of(pair_lane[i]) = *contact(i);
    }
    for (int i = 0; i < count; ++i) {
      const bool settled = least_m[lane[i]] <= std::min(after_m[i], known_m[i]);
      if (!settled || of_least_m[lane[i]] > blend_m) to_exact.set(lane[i], true);
    }
  }

 private:
  HWY_INLINE void add_pairs(M of, VI lanes, VI column) {
    const Pack pack(of);
    pack.store(lanes, pair_lane + pairs);
    pack.store(column, pair_column + pairs);
    pairs += pack.count();
  }
};

/// Writes exact contacts of some lanes of a batch.
inline Status query_lanes(const PosedUnion& proxy, const Batch& batch, const LaneBits& which,
                          const ContactOutput& out) {
  InRange lanes;
  for (int begin = 0; begin < batch.at.count; begin += kBlock)
    for (std::uint64_t left = which.from(begin); left != 0; left &= left - 1) {
      const int lane = begin + std::countr_zero(left);
      if (lane >= batch.at.count) break;
      lanes.x[lanes.count] = batch.at.x[lane];
      lanes.y[lanes.count] = batch.at.y[lane];
      lanes.z[lanes.count] = batch.at.z[lane];
      lanes.lane[lanes.count++] = lane;
    }
  if (lanes.count == 0) return Status::kDone;
  const int end = (lanes.count + kBlock - 1) / kBlock * kBlock;
  for (float* values : {lanes.x, lanes.y, lanes.z})
    std::fill(values + lanes.count, values + end, values[lanes.count - 1]);
  std::fill(lanes.lane + lanes.count, lanes.lane + end, -1);
  Kernel<PosedUnion> kernel(proxy);
  Batch some{.at = {lanes.x, lanes.y, lanes.z, lanes.count}};
  BatchResults found;
  const Status status = nearest(kernel, some, found);
  if (status == Status::kDone) write_in_range(lanes, found, out);
  return status;
}

}  // namespace bodice::collision::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
